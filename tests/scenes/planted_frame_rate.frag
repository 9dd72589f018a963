// A planted simulation that depends on the frame rate: a ball moves by a pixel a frame, not by a way
// a second.
uniform sampler2D ball;       //@ pass mainBall size=1x1
void mainBall(out vec4 state, in vec2 pixel) {
    vec4 s = texelFetch(ball, ivec2(0), 0);
    s.x = abs(s.x) < 1.0 ? s.x + 0.004 : 0.0;
    state = vec4(s.x, 0.0, 0.0, 1.0);
}
void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float x = texelFetch(ball, ivec2(0), 0).x;
    colour = vec4(vec3(1.0 - smoothstep(0.1, 0.15, abs(uv.x - x))), 1.0);
}

// A planted explosion: an explicit Euler step of an undamped spring adds energy in every step.
uniform sampler2D spring;     //@ pass mainSpring size=1x1 step=1/60
void mainSpring(out vec4 state, in vec2 pixel) {
    vec2 s = texelFetch(spring, ivec2(0), 0).xy;
    if (iFrame == 0) s = vec2(1.0, 0.0);
    state = vec4(s + iTimeDelta * vec2(s.y, -81.0 * s.x), 0.0, 1.0);
}
void mainImage(out vec4 colour, in vec2 pixel) {
    float place = clamp(texelFetch(spring, ivec2(0), 0).x, -1.0, 1.0);
    colour = vec4(vec3(0.5 + 0.4 * place), 1.0);
}

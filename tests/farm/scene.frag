// A simulation, and a picture that takes some time.
uniform sampler2D walk; //@ pass mainWalk size=16x16 step=1/240

void mainWalk(out vec4 c, in vec2 p) {
    c = texelFetch(walk, ivec2(p), 0) + sin(vec4(p, iTime, iFrame));
}

void mainImage(out vec4 c, in vec2 p) {
    vec4 w = texelFetch(walk, ivec2(p) % 16, 0);
    for (int i = 0; i < 600; ++i) w = fract(w * 1.01 + 0.1).yzwx;
    c = vec4(w.rgb, 1);
}

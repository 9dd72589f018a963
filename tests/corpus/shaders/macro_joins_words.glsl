// Joining of words is of other languages; here it stands where nobody compiles it.
#ifdef FOR_THE_DESKTOP
#define JOIN(a, b) a##b
float JOIN(wa, ve)(float x) { return sin(x); }
#else
#define wave(x) sin(x)
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    fragColor = vec4(vec3(0.5 + 0.5 * wave(p.x * 8.0) * wave(p.y * 8.0)), 1.0);
}

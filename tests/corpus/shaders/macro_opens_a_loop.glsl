// Loops that begin in one macro and end in another.
#define EACH(i, n) for (int i = 0; i < n; ++i) {
#define DONE }
float unused() { return 1.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = 4.0 * fragCoord / iResolution.y;
    float d = 9.0;
    EACH(y, 4)
        EACH(x, 7)
            d = min(d, distance(p, vec2(x, y) + 0.5 + 0.2 * sin(vec2(y, x) * 2.0)));
        DONE
    DONE
    fragColor = vec4(d, 1.0 - d, 0.4, 1.0);
}

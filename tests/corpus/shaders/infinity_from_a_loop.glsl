// The nearest of several, started from a number that no float holds.
#define INF 1e39
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    float nearest = INF, far = -INF;
    for (float i = 0.0; i < 5.0; ++i) {
        float d = distance(p, vec2(0.2 + 0.35 * i, 0.5 + 0.3 * sin(i * 2.0)));
        nearest = min(nearest, d);
        far = max(far, d);
    }
    fragColor = vec4(nearest * 2.0, far * 0.5, nearest < INF ? 0.3 : 0.9, 1.0);
}

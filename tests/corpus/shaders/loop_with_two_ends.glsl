// A loop left by break from within another, with counters that outlive it.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 c = 3.0 * fragCoord / iResolution.xy - vec2(2.0, 1.5), z = c;
    int n = 0, m = 0;
    for (int i = 0, j = 20; i < j; i += 2, --j) {
        for (int k = 0; k < 3; ++k) {
            z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
            ++n;
            if (dot(z, z) > 4.0) break;
        }
        if (dot(z, z) > 4.0) { m = j; break; }
    }
    fragColor = vec4(float(n) / 21.0, float(m) / 20.0, m == 0 ? 0.4 : 0.1, 1.0);
}

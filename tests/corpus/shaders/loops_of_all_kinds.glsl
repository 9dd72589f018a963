// while, do and for with break and continue, and a loop in a loop.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int n = int(fragCoord.x) + 1, steps = 0, bits = 0, inner = 0;
    while (n != 1 && steps < 128) { n = (n & 1) == 0 ? n / 2 : 3 * n + 1; steps++; }
    int m = int(fragCoord.y);
    do { bits += m & 1; m >>= 1; } while (m > 0);
    for (int i = 0; i < 20; i++) {
        if (i % 3 == 0) continue;
        for (int j = 0;; j += 2) { if (j > i) break; inner++; }
        if (inner > int(fragCoord.x)) break;
    }
    fragColor = vec4(float(steps) / 128.0, float(bits) / 6.0, float(inner) / 80.0, 1.0);
}

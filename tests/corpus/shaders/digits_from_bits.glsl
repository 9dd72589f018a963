// Digits without a picture: fifteen bits each, three to a row.
const int kDigits[10] = int[](31599, 11415, 29671, 29647, 23497, 31183, 31215, 29257, 31727, 31695);
int pixel(ivec2 p, int digit) { return p.x < 0 || p.x > 2 || p.y < 0 || p.y > 4 ? 0 : kDigits[digit] >> (p.y * 3 + 2 - p.x) & 1; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) / 4 - ivec2(2, 6);
    int number = iFrame * 4321, ink = 0;
    for (int i = 6; i >= 0; --i) { ink |= pixel(p - ivec2(i * 4, 0), number % 10); number /= 10; }
    fragColor = vec4(ink == 1 ? vec3(0.2, 1.0, 0.4) : vec3(0.0, 0.1, 0.05), 1.0);
}

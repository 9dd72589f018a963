// The comma, ++ and -- before and behind, assignments as values.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int a = int(fragCoord.x) / 8, b, c;
    b = a++;
    b += (c = a, c * 2);
    float x = float(--b), y = (x += 1.0, x *= 0.5);
    int i = 0, t[3] = int[](5, 7, 9);
    c = t[i++] * 2;
    --i;
    c += t[i]--;
    fragColor = vec4(x / 32.0, y / 24.0 * fragCoord.y / 72.0, float(c) / 20.0, 1.0);
}

// Signed numbers wrap as well; the least one has no counterpart.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int x = int(fragCoord.x) * 33554431, y = int(fragCoord.y) * 65537;
    int least = -2147483647 - 1;
    int wrapped = 2147483647 + int(fragCoord.x) + 1;
    bool same = -least == least && abs(least) == least;
    fragColor = vec4(float(x * y & 255) / 255.0, float(wrapped - least) / 128.0, same ? 0.7 : 0.2, 1.0);
}

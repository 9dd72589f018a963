// Words and a counter from a picture of letters, sixteen to a row from the space on.
float letter(vec2 p, int code) {
    if (any(lessThan(p, vec2(0.0))) || any(greaterThanEqual(p, vec2(1.0)))) return 0.0;
    vec2 cell = vec2((code - 32) % 16, (code - 32) / 16);
    return texelFetch(iChannel0, ivec2(cell.x * 8.0 + p.x * 8.0, 47.0 - cell.y * 8.0 - (1.0 - p.y) * 8.0 + 0.5), 0).r;
}
const int kWord[6] = int[](71, 76, 73, 78, 84, 58);
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (fragCoord - vec2(6.0, 30.0)) / 14.0;
    float ink = 0.0;
    for (int i = 0; i < 6; ++i) ink += letter(p - vec2(i, 0), kWord[i]);
    ink += letter(p - vec2(6, 0), 48 + iFrame / 10 % 10) + letter(p - vec2(7, 0), 48 + iFrame % 10);
    fragColor = vec4(mix(vec3(0.1, 0.1, 0.2), vec3(1.0, 0.8, 0.3), ink), 1.0);
}

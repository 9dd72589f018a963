// The Gray code of the column, a bit a row: neighbours differ in one.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int x = int(fragCoord.x) / 4, row = int(fragCoord.y) / 12;
    int gray = x ^ (x >> 1);
    fragColor = vec4(vec3((gray >> min(row, 31)) & 1) * vec3(0.9, 0.8, 0.5), 1.0);
}

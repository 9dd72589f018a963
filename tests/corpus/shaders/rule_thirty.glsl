// A row of cells is one number of 32 bits; the picture's height is its history.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    uint row = 0x00010000u;
    for (int i = 71 - int(fragCoord.y); i > 0; i -= 3) row = (row >> 1 | row << 31) ^ (row | (row << 1 | row >> 31));
    fragColor = vec4(vec3(row >> (31 - min(int(fragCoord.x) / 4, 31)) & 1u) * vec3(0.7, 0.9, 1.0), 1.0);
}

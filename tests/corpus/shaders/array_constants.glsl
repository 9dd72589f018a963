const int kRow[5] = int[5](0x0E, 0x11, 0x1F, 0x11, 0x11);
const vec3 kInk[] = vec3[](vec3(0.9, 0.2, 0.1), vec3(0.1, 0.7, 0.3), vec3(0.2, 0.3, 0.9));
const float kStep = 1.0 / float(kRow.length());
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 cell = ivec2(fragCoord / 12.0);
    int row = 4 - cell.y % 5, bit = 4 - cell.x % 5;
    bool ink = (kRow[row] >> bit & 1) == 1;
    fragColor = vec4(ink ? kInk[cell.x / 5 % kInk.length()] : vec3(kStep * float(row)), 1.0);
}

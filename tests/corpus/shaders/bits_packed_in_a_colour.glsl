// A map of sixteen by nine in nine numbers, drawn from their bits.
const int kRows[9] = int[9](0x0000, 0x3C3C, 0x4242, 0x9999, 0x8181, 0xA5A5, 0x4242, 0x3C3C, 0x0000);
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = min(ivec2(fragCoord) / 8, ivec2(15, 8));
    bool on = (kRows[p.y] & (1 << p.x)) != 0;
    fragColor = vec4(on ? vec3(0.95, 0.8, 0.2) : vec3(0.1, 0.2, 0.3), 1.0);
}

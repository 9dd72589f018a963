// A flag that only some pixels raise, and a count that only those write.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    bool inside, edge;
    int rings;
    uint bits;
    if ((p.x / 16 + p.y / 16) % 3 == 0) { inside = true; rings = 3; }
    if (p.x % 16 == 0) { edge = true; bits |= 128u; }
    fragColor = vec4(inside ? 0.8 : 0.1, float(rings) * 0.2, edge ? float(bits) / 255.0 : 0.0, 1.0);
}

// Xorshift, and what a xor of places looks like beside it.
uint xorshift(uint s) { s ^= s << 13; s ^= s >> 17; s ^= s << 5; return s; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    uvec2 p = uvec2(fragCoord);
    uint s = p.x * 1973u + p.y * 9277u | 1u;
    for (int i = 0; i < 4; ++i) s = xorshift(s);
    fragColor = vec4(float(s & 0xFFu) / 255.0, float((p.x ^ p.y) & 63u) / 63.0, float(p.x & p.y) / 127.0, 1.0);
}

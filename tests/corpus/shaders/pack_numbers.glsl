// Two numbers in one: as halves, as signed and as unsigned 16-bit fractions.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    uint h = packHalf2x16(uv * 10.0), s = packSnorm2x16(uv * 2.0 - 1.0), n = packUnorm2x16(uv);
    vec2 from_h = unpackHalf2x16(h) / 10.0, from_s = unpackSnorm2x16(s), from_n = unpackUnorm2x16(n);
    fragColor = vec4(from_h.x, from_s.y * 0.5 + 0.5, float(h >> 10 & 31u) / 31.0, 1.0);
    fragColor.g *= from_n.x;
}

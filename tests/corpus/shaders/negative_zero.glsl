// -0 equals 0 and yet has its sign, which division and bits show.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float zero = min(fragCoord.x, 0.0), minus = zero * -1.0;
    bool same = zero == minus;
    uint sign_bit = floatBitsToUint(minus) >> 31;
    fragColor = vec4(same ? 0.8 : 0.1, float(sign_bit) * 0.6, fragCoord.x / 128.0, 1.0);
}

// Not-a-number is unequal to all, itself too, and spreads through sums.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = fragCoord.x < 64.0 ? uintBitsToFloat(0x7fc00000u) : fragCoord.x / 128.0;
    float y = x * 2.0 - x;
    bool equal_self = x == x, less = y < 0.8, not_less = !(y < 0.8);
    fragColor = vec4(isnan(y) ? 0.9 : y * 0.5, float(equal_self) * 0.6, float(less) * 0.3 + float(not_less) * 0.6, 1.0);
}

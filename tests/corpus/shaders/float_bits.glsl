// The fields of a float: its exponent, its fraction, its sign; and back.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = (fragCoord.x - 64.0) * exp2(floor(fragCoord.y / 9.0));
    uint bits = floatBitsToUint(x);
    float exponent = float(bits >> 23 & 255u) - 127.0;
    float mantissa = uintBitsToFloat(bits & 0x7fffffu | 0x3f800000u);
    float sign_of = float(floatBitsToInt(x) < 0);
    float half_of = uintBitsToFloat(bits - (1u << 23));
    fragColor = vec4((exponent + 1.0) / 16.0, mantissa - 1.0, sign_of * 0.5 + float(half_of * 2.0 == x) * 0.5, 1.0);
}

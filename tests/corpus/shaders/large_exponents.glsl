// From the least normal number to the largest, and exponents taken apart.
float ldexp_(float m, float e) { return m * uintBitsToFloat(uint(e + 127.0) << 23); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float e = floor(fragCoord.x) * 2.0 - 126.0;
    float x = ldexp_(1.5, e);
    float back = log2(x / 1.5);
    fragColor = vec4((back + 126.0) / 254.0, x > 1.0 ? 0.8 : 0.2, sqrt(x) * inversesqrt(x) * 0.5, 1.0);
}

// Infinity is above all numbers; it minus itself is none.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float zero = min(fragCoord.x, 0.0), inf = uintBitsToFloat(0x7f800000u) + zero;
    float x = fragCoord.x < 64.0 ? inf : fragCoord.y < 36.0 ? -inf : 1e30;
    fragColor = vec4(isinf(x) ? 0.9 : 0.1, isnan(x - inf) ? 0.8 : 0.2, x > 1e29 ? 0.7 : 0.3, 1.0);
    fragColor.rgb *= 1.0 / (1.0 + 1.0 / x);
}

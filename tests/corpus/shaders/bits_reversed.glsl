// Columns in the order of reversed bits: van der Corput's sequence.
float radicalInverse(uint bits) {
    bits = (bits << 16u) | (bits >> 16u);
    bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xAAAAAAAAu) >> 1u);
    bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xCCCCCCCCu) >> 2u);
    bits = ((bits & 0x0F0F0F0Fu) << 4u) | ((bits & 0xF0F0F0F0u) >> 4u);
    bits = ((bits & 0x00FF00FFu) << 8u) | ((bits & 0xFF00FF00u) >> 8u);
    return float(bits) * 2.3283064365386963e-10;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float h = radicalInverse(uint(fragCoord.x));
    fragColor = vec4(fragCoord.y / iResolution.y < h ? vec3(0.2, 0.6, 0.9) : vec3(0.05), 1.0);
}

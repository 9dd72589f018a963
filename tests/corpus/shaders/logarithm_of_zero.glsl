// Logarithms, powers and roots at the edge of where they are said.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = floor(fragCoord / 8.0) / vec2(16.0, 9.0);
    float a = exp2(log2(uv.x)), b = clamp(-log(uv.y), 0.0, 2.0) * 0.4;
    fragColor = vec4(a, b, pow(uv.x, 0.5) * inversesqrt(1.0 + uv.y), 1.0);
}

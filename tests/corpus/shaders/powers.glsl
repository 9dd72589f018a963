// pow, exp, exp2, log, log2, sqrt, inversesqrt.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy + 0.01;
    fragColor = vec4(pow(uv.x, 2.2 * uv.y), exp(-3.0 * uv.x) + exp2(-8.0 * uv.y), 0.5 + 0.1 * log(uv.x) + 0.05 * log2(uv.y), 1.0);
    fragColor.b += 0.2 * sqrt(uv.x) - 0.02 * inversesqrt(uv.y);
}

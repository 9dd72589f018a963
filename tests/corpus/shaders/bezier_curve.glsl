// The distance to a quadratic curve, by sampling.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y, a = vec2(0.2), b = vec2(0.9, 1.3), c = vec2(1.6, 0.3);
    float d = 9.0;
    for (int i = 0; i <= 32; ++i) { float t = float(i) / 32.0; d = min(d, distance(p, mix(mix(a, b, t), mix(b, c, t), t))); }
    fragColor = vec4(vec3(0.1, 0.3, 0.5) + (1.0 - smoothstep(0.02, 0.05, d)) * vec3(0.8, 0.5, 0.1), 1.0);
}

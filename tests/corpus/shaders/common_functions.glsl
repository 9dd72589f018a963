// step, smoothstep, clamp, mix, sign, min and max, of vectors and with numbers beside vectors.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 c = mix(vec3(uv, 0.5), vec3(0.3), smoothstep(0.2, 0.8, uv.x));
    c = clamp(c, vec3(0.2, 0.1, 0.0), vec3(0.8));
    c += 0.2 * step(0.6, uv.y) - 0.1 * sign(uv.x - 0.5);
    c = max(min(c, 0.9), 0.15 * uv.yyx);
    fragColor = vec4(c, 1.0);
}

// Edges a pixel wide, by fwidth.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (fragCoord - vec2(64.0, 80.0)) / iResolution.y;
    vec2 q = vec2(p.x, 0.3) / -p.y * 4.0, w = max(fwidth(q), 0.001);
    vec2 s = clamp((abs(fract(q * 0.5) - 0.5) - 0.25) / w + 0.5, 0.0, 1.0);
    fragColor = vec4(vec3(mix(s.x, 1.0 - s.x, s.y)), 1.0);
}

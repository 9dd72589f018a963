// A picture of what has no end: a slope through a constant of zero, clamped to what can be seen.
const float ZERO = 0.0;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float a = clamp(p.x / 0.0, 0.0, 1.0);
    float b = clamp(p.y / ZERO, -1.0, 1.0) * 0.5 + 0.5;
    float c = min(1.0 / 0.0, 0.7);
    fragColor = vec4(a, b, c, 1.0);
}

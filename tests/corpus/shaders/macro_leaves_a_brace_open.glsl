// A loop that a macro opens and the text closes; functions behind it that are used before they are written.
#define EACH(i, n) for (int i = 0; i < n; ++i) {
float ring(vec2 p, float r);
vec3 rings(vec2 p) {
    vec3 c = vec3(0.1);
    EACH(i, 5)
        c += ring(p, 0.15 * float(i + 1)) * vec3(0.2, 0.1 * float(i), 0.3);
    }
    return c;
}
float ring(vec2 p, float r) { return smoothstep(0.05, 0.0, abs(length(p) - r)); }
vec3 tint(vec3 c) { return c * vec3(1.0, 0.8, 0.6); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    fragColor = vec4(tint(rings(p)), 1.0);
}

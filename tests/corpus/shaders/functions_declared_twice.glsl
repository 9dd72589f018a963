// Declared before, declared again, and defined behind mainImage, with and without names.
float height(vec2);
float height(vec2 place);
vec3 shade(float h, const vec2 slope);
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y * 4.0, e = vec2(0.01, 0.0);
    fragColor = vec4(shade(height(p), vec2(height(p + e) - height(p), height(p + e.yx) - height(p)) * 100.0), 1.0);
}
float height(vec2 p) { return 0.5 + 0.25 * sin(p.x) + 0.25 * cos(p.y * 1.3); }
vec3 shade(float h, const vec2 slope) { return vec3(h, 0.5 + 0.4 * slope) * 0.9; }

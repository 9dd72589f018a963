#define T(p) texture(iChannel0, (p) / iResolution.xy)
vec2 force(vec2 p) { return 0.6 * exp(-dot(p, p) / 60.0) * vec2(1.0, 0.3); }

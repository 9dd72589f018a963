// Lines joined by a backslash before a line end of two bytes.
#define GLOW(d) \
    (0.1 / \
     (0.1 + (d)))
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
#if defined(GLOW) && \
    1
    fragColor = vec4(GLOW(abs(length(p) - 0.6)), GLOW(abs(p.x)), 0.2, 1.0);
#endif
}

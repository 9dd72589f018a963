// A macro that opens a bracket which its users close.
#define S max(0.0,
#define LIGHT(p) pow(S 1.0 - length(p)), 2.0)
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float lower = S -p.y);
    fragColor = vec4(LIGHT(p), S p.x) * 0.5, lower * 0.4, 1.0);
}

// A scene in macros of several lines, with comments at the ends and in the middle of lines.
#define SPHERE(at, r, c) /* place, radius */ \
    d = length(p - at) - r;                  \
    if (d < nearest) {                       \
        nearest = d; /* the nearest wins */  \
        colour = c;                          \
    }   // the end
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    float d, nearest = 0.0;
    vec3 colour = vec3(0.1, 0.1, 0.2);
    SPHERE(vec2(0.5, 0.5), 0.3, vec3(0.8, 0.2, 0.1))
    SPHERE(vec2(0.9, 0.4), 0.25, vec3(0.1, 0.7, 0.3))
    SPHERE(vec2(1.3, 0.6), 0.3, vec3(0.9, 0.8, 0.2))
    fragColor = vec4(colour, 1.0);
}

// Macros that paste names are an error where they are used, and nobody uses these: one names itself, two each other.
#define JOIN(a, b) a##b
#define NAMED(a) JOIN(a, 1)
#define vec(n) vec##n
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float dmat2x2 = 0.5, dmat4x3 = 0.25;
    fragColor = vec4(fragCoord / iResolution.xy, dmat2x2 + dmat4x3, 1.0);
}

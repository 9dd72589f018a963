// Macros of several lines, of macros, with brackets in arguments, named as functions without a call.
#define BOX(p, c, s, k) \
    if (all(lessThan(abs((p) - (c)), \
                     (s)))) \
        k
#define TWICE(x) ((x) + (x))
#define APPLY(f, x) f(x)
#define half (0.5)
#define f(x) TWICE(x * half)
#define EMPTY
#define COMMA ,
float TWICE_(float f) { return f; }
void mainImage(out vec4 fragColor, in vec2 fragCoord EMPTY) {
    vec2 p = fragCoord / iResolution.y;
    vec3 c = vec3(0.1 COMMA 0.2, 0.1);
    BOX(p, vec2(0.5, 0.5), vec2(0.2, 0.3), c.r = APPLY(TWICE, p.x * 0.4);)
    BOX(p, vec2(1.2, 0.4), min(vec2(0.4, 0.2), vec2(0.3)), { c.g = f(p.y); c.b = 1.0; })
    fragColor = vec4(c, TWICE_(1.0));
}

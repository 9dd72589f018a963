// Macros as arguments of macros, a macro that names itself, and one that another completes.
#define SQUARE(x) ((x) * (x))
#define QUAD(x) SQUARE(SQUARE(x))
#define LERP(a, b, t) ((a) + ((b) - (a)) * (t))
#define CALL(f, x) f(x)
#define ADD(a, b) a + b
#define PAIR 0.2, 0.6
#define LERP_PAIR(p, t) LERP_(p, t)
#define LERP_(a, b, t) mix(a, b, t)
float fold(float x) { return abs(fract(x) - 0.5); }
#define fold(x) (2.0 * fold(x))
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a = LERP(CALL(SQUARE, uv.x), QUAD(uv.y), fold(uv.x * 2.0));
    fragColor = vec4(a, LERP_PAIR(PAIR, uv.x), (ADD(0.1, uv.y)) * 0.5, 1.0);
}

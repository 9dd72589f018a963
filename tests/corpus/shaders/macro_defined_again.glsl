// One name for several things, one after the other.
#define COLOUR vec3(0.9, 0.5, 0.1)
vec3 first() { return COLOUR; }
#undef COLOUR
#define COLOUR(x) vec3(0.1, x, 0.7)
vec3 second(float x) { return COLOUR(x); }
#undef COLOUR
#undef NEVER_DEFINED
#define SAME 0.5
#define SAME 0.5
vec3 COLOUR(vec3 a, vec3 b) { return a * SAME + b * SAME; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv.x < 0.33 ? first() : uv.x < 0.66 ? second(uv.y) : COLOUR(first(), second(uv.y)), 1.0);
}

// Brackets keep commas together; arguments may be empty, statements, or types.
#define REPEAT(n, body) for (int k = 0; k < n; ++k) { body; }
#define NEW(type, name, value) type name = type(value)
#define NONE(x) 0.1 x
#define PICK(c, a, b) ((c) ? (a) : (b))
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    NEW(vec3, c, 0.1);
    NEW(vec2, q, (uv.x, uv));
    REPEAT(4, c.r += PICK(uv.x > float(k) * 0.25, min(0.2, uv.y), 0.0); c.g = max(c.g, c.r * 0.5))
    fragColor = vec4(c + NONE() + NONE(* q.y), 1.0);
}

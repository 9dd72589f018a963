// A function of the language, for a struct that the language does not know.
struct Look { vec3 colour; float width; };
Look mix(Look a, Look b, float t) { return Look(mix(a.colour, b.colour, t), mix(a.width, b.width, t)); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    Look look = mix(Look(vec3(0.9, 0.3, 0.1), 0.02), Look(vec3(0.2, 0.5, 0.9), 0.3), uv.x);
    fragColor = vec4(abs(uv.y - 0.5) < look.width ? look.colour : vec3(0.1), 1.0);
}

// A material of which only the albedo is said.
struct Material { vec3 albedo; float gloss; bool glows; };
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    Material paint;
    paint.albedo = vec3(uv, 0.4);
    fragColor = vec4(paint.albedo + paint.gloss + (paint.glows ? 0.5 : 0.0), 1.0);
}

// Averages from the small levels of a buffer; another channel reads the same buffer repeated.
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = uv.y < 0.5 ? textureLod(iChannel0, uv, floor(uv.x * 4.0) + 4.0) : texture(iChannel1, uv * 2.5);
}

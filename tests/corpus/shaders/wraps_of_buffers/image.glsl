void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = p.x < 64.0 ? texture(iChannel3, uv) : texture(iChannel0, uv * 2.0 - 0.5);
}

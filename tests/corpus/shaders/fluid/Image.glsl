void mainImage(out vec4 f, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    f = vec4(texture(iChannel2, uv).rg, 0.5 + texture(iChannel1, uv).x, 1.0);
}

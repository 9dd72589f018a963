// A planted failure of age: one wave on exact phases, a fainter one on a float clock beside it.
void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float exact = 6.2831853 * (4.0 * uv.x - float(131072u * iTick) / 4294967296.0);
    colour = vec4(vec3(0.5 + 0.3 * sin(exact) + 0.1 * sin(9.0 * uv.y + 3.0 * iTime)), 1.0);
}

// A planted hang: harmless in a small picture, endless in a large one.
void mainImage(out vec4 colour, in vec2 pixel) {
    float x = pixel.x;
    int turns = iResolution.x > 1000.0 ? 60000 : 1;
    for (int i = 0; i < turns; ++i) x = sin(x) + pow(abs(x), 0.3);
    colour = vec4(vec3(0.5 + 0.1 * x), 1.0);
}

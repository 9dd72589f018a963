// A planted division by nothing: in a picture of one column every pixel is in the middle.
void mainImage(out vec4 colour, in vec2 pixel) {
    float x = (pixel.x - 0.5) / (iResolution.x - 1.0);
    colour = vec4(vec3(x), 1.0);
}

// A planted divergence: nothing is divided by no parts.
uniform int parts;            //@ 2 [0, 4] quality reference=4 "of the mean"

void mainImage(out vec4 colour, in vec2 pixel) {
    float sum = 0.0;
    for (int i = 0; i < parts; ++i) sum += pixel.x / iResolution.x * float(i + 1);
    colour = vec4(vec3(sum / float(parts) * 0.3), 1.0);
}

// A planted wrong reference: what counts as the truth is another picture, a little too bright.
uniform int steps;            //@ 8 [1, 64] log quality reference=4096 "parts of the interval"

void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        float s = (float(i) + 0.5) / float(steps);
        sum += exp(-2.0 * uv.x * s);
    }
    float bright = steps > 1000 ? 1.03 : 1.0;
    colour = vec4(vec3(0.5 * bright * sum / float(steps)), 1.0);
}

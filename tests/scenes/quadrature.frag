// An integral by sums: the left rule is of order 1, the midpoint rule of order 2.
uniform int steps;            //@ 8 [1, 64] log quality reference=4096 "parts of the interval"
uniform int rule;             //@ 1 {left, midpoint} "where in its part the function is taken"

void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float sum = 0.0, offset = rule == 0 ? 0.0 : 0.5;
    for (int i = 0; i < steps; ++i) {
        float s = (float(i) + offset) / float(steps);
        sum += exp(-2.0 * uv.x * s) * (1.0 + uv.y * s);
    }
    colour = vec4(vec3(0.5 * sum / float(steps)), 1.0);
}

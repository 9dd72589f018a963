// A planted bad method: a sum that is rounded to a byte at each step is worse for every step more.
uniform int steps;            //@ 8 [1, 64] log quality reference=4096 "beyond 1000: in closed form"

void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float light = 0.8 * uv.x;
    if (steps < 1000) {
        light = 0.0;
        for (int i = 0; i < steps; ++i) {
            light = floor((light + 0.8 * uv.x / float(steps)) * 255.0) / 255.0;
        }
    }
    colour = vec4(vec3(light), 1.0);
}

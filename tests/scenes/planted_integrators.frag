// An integral by sums whose orders are known, by random samples, and by a method that goes nowhere.
uniform int   steps;          //@ 8 [1, 64] log quality reference=1024 "parts of the interval, or samples"
// left: order 1; midpoint: 2; simpson: 4; samples: 1/2, of which more contain fewer; restless: none.
uniform int   rule;           //@ 1 {left, midpoint, simpson, samples, restless} "how it is summed"
uniform float bias;           //@ 0 [0, 1] "what the truth has, and what nears it has not"

float hash(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return float(v.x >> 8u) / 16777216.0;
}

float integrand(vec2 uv, float s) {
    return exp(-2.0 * (0.2 + uv.x) * s) * (1.0 + uv.y * s);
}

float term(vec2 uv, uvec2 cell, int i) {
    float a = float(i) / float(steps), b = float(i + 1) / float(steps);
    if (rule == 0) return integrand(uv, a);
    if (rule == 1) return integrand(uv, 0.5 * (a + b));
    if (rule == 3) return integrand(uv, hash(uvec3(cell, i)));
    return (integrand(uv, a) + 4.0 * integrand(uv, 0.5 * (a + b)) + integrand(uv, b)) / 6.0;
}

void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += term(uv, uvec2(pixel), i);
    float light = 0.5 * sum / float(steps);
    if (rule == 4) light = hash(uvec3(uvec2(pixel), 7919 * steps));
    if (steps > 100) light += bias;
    colour = vec4(vec3(light), 1.0);
}

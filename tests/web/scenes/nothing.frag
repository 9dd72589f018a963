// What is divided by tweaks that are 0, in every way that a text may have it: the page shows what the still shows.
uniform float none;   //@ 0 [0, 1]
uniform int nought;   //@ 0 [0, 5]
uniform vec2 pair;    //@ 0,0 [0, 1]
const float TWICE = 2.0;

float by(float a, float b) { return a / b; }

// Magenta: not a number; yellow and cyan: infinite.
vec3 told(float x) {
    if (isnan(x)) return vec3(1.0, 0.0, 1.0);
    if (isinf(x)) return x > 0.0 ? vec3(1.0, 1.0, 0.0) : vec3(0.0, 1.0, 1.0);
    return vec3(clamp(x, 0.0, 1.0), 0.2, 0.3);
}

void mainImage(out vec4 color, in vec2 coord) {
    vec2 uv = coord / iResolution.xy;
    int cell = int(uv.x * 4.0) + 4 * int(uv.y * 4.0);
    float x = fract(uv.x * 4.0) - 0.25, v = 0.0, assigned = x;
    assigned /= none;
    if (cell == 0) v = x / none;
    if (cell == 1) v = x / (2.0 * none);
    if (cell == 2) v = (vec2(x) / pair).x;
    if (cell == 3) v = x / pair.y;
    if (cell == 4) v = mod(x, none);
    if (cell == 5) v = by(x, none);
    if (cell == 6) v = 1.0 / none;
    if (cell == 7) v = x / float(nought);
    if (cell == 8) v = assigned;
    if (cell == 9) v = x / (none + 0.0);
    if (cell == 10) v = x * (1.0 / none);
    if (cell == 11) v = x / (none * TWICE);
    if (cell == 12) v = (vec2(x) / vec2(none)).y;
    if (cell == 13) v = 0.0 / none;
    if (cell == 14) v = (x + none) / none;
    if (cell == 15) v = length(vec2(x, 0.2) / none) / (x / none);
    color = vec4(told(v), 1.0);
}

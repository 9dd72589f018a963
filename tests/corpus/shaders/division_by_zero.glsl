// What is divided by a constant zero is infinite with its sign, and nothing by nothing is no number.
#define NOTHING 0.

float kind(float x) {
    return x > 1e30 ? 1.0 : x < -1e30 ? 0.5 : x == x ? 0.25 : 0.0;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float w = floor(fragCoord.x / 16.0) - 3.0;
    float by_literal = w / 0.0;
    float by_macro = w / NOTHING * 2.0;
    float in_place = w;
    in_place /= (0.0);
    vec2 both = vec2(w, -w) / vec2(0.0);
    float row = floor(fragCoord.y / 18.0);
    float x = row < 1.0 ? by_literal : row < 2.0 ? by_macro : row < 3.0 ? in_place : both.y;
    fragColor = vec4(kind(x), fragCoord / iResolution.xy, 1.0);
}

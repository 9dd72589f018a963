// Divisions by zeros that a compiler finds out by itself: a local, an argument, the first turn of a loop that it unrolls,
// a variable that was never set. All are infinite, and what is clamped is white.
float slope(float rise, float run) { return rise / run; }

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = 0.1 + fragCoord / iResolution.xy;
    float nothing = 0.0;
    vec3 none = vec3(0);
    float unset, sum = 0.0;
    for (float depth = 0.0; depth < 4.0; depth++) sum += 0.1 * clamp(0.3 * uv.x / depth, 0.0, 1.0);
    float turns = 0.0;
    for (int i = 0; i < 3; i++) turns += 0.2 * clamp(0.4 * uv.y / float(i), 0.0, 1.0);
    vec3 three = clamp(uv.xyx / none, 0.0, 1.0);
    fragColor.r = 0.25 * clamp(uv.x / nothing, 0.0, 1.0) + 0.25 * three.y + sum;
    fragColor.g = 0.5 * clamp(slope(uv.y, 0.0), 0.0, 1.0) + turns;
    fragColor.b = 0.25 * clamp(-uv.x / unset, -1.0, 1.0) + 0.25 * clamp(slope(uv.x, 0.5), 0.0, 1.0) + 0.4;
    fragColor.a = 1.0;
}

// Variables called as functions are, and functions called as the host's own parts.
float color(float coord) { return coord * coord; }
float time(float distance) { return distance * 0.5 + iTime * 0.1; }
void mainImage(out vec4 mix, in vec2 step) {
    vec2 length = step / iResolution.xy;
    float smoothstep = length.x, sin = length.y;
    float max = color(smoothstep), min = time(sin);
    mix = vec4(max, min, max > min ? 0.3 : 0.9, 1.0);
}

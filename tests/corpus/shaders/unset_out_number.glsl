// A march that says how far it came, and how many steps it took only where it hit.
bool march(vec2 p, out float t, out int steps) {
    for (int i = 0; i < 20; ++i) {
        float d = length(p + vec2(t, 0.0) - vec2(1.2, 0.5)) - 0.3;
        if (d < 0.01) { steps = i; return true; }
        t += d;
    }
    return false;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float t = 5.0;
    int steps = 7;
    bool hit = march(vec2(0.0, fragCoord.y / iResolution.y), t, steps);
    float x = fragCoord.x / iResolution.y;
    fragColor = vec4(hit && x > t ? 0.9 : 0.1, float(steps) * 0.1, 0.3, 1.0);
}

// A table within a function, of a length that another constant says, read at a place that varies.
const int kCount = 2 * 4;
float note(int i) {
    const float kScale[kCount] = float[kCount](0.0, 0.15, 0.3, 0.35, 0.5, 0.65, 0.8, 1.0);
    return kScale[i & (kCount - 1)];
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int i = int(fragCoord.x / 8.0);
    fragColor = vec4(step(fragCoord.y / iResolution.y, note(i)), note(i + 3), note(i * 3), 1.0);
}

// Counts by letter: an array that nobody cleared.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int count[4];
    int cell = int(fragCoord.x) / 8 + int(fragCoord.y) / 8;
    for (int i = 0; i < 6; ++i) count[(cell * i) % 4]++;
    fragColor = vec4(float(count[0]), float(count[1]), float(count[2] + count[3]), 6.0) / 6.0;
}

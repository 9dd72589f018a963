// Arrays by value: a function sorts its own copy and gives it back.
float[5] sorted(float a[5]) {
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4 - i; ++j)
            if (a[j] > a[j + 1]) { float t = a[j]; a[j] = a[j + 1]; a[j + 1] = t; }
    return a;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float bars[5] = float[5](0.7, 0.2, 0.9, 0.4, 0.5);
    float[5] order = sorted(bars);
    int i = int(fragCoord.x / iResolution.x * 5.0);
    float y = fragCoord.y / iResolution.y;
    fragColor = vec4(step(y, order[i]), step(y, bars[i]), order[i] - bars[i] + 0.5, 1.0);
}

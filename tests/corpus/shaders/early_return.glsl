// Returns from the middle of a loop and of mainImage itself.
float first_square_above(float x) {
    for (int i = 0; i < 20; ++i) {
        float s = float(i * i);
        if (s > x) return s;
    }
    return 0.0;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(0.2, 0.0, 0.3, 1.0);
    if (fragCoord.x < 20.0) return;
    fragColor.r = first_square_above(fragCoord.x * 2.0) / 256.0;
    if (fragCoord.y < 20.0) { fragColor.g = 1.0; return; }
    fragColor.b = first_square_above(fragCoord.y) / 81.0;
}

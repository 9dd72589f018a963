// Comparisons with what has no end, which every row asks anew.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = fragCoord.x / iResolution.x;
    float far = exp(1000.0 * x), lost = far - far;
    int row = int(fragCoord.y) / 18;
    bool yes = row == 0 ? far > 1e38 : row == 1 ? isinf(far) : row == 2 ? isnan(lost) : 1.0 / far == 0.0;
    fragColor = vec4(yes ? vec3(0.9, 0.7, 0.2) : vec3(0.1, 0.1, 0.3), 1.0);
}

// As above, in loops of two kinds within one another, and with an array.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float total = 0.0;
    int i = 0;
    while (i < 4) {
        float row;
        do {
            float cell[2];
            cell[i % 2] += 0.25;
            row += cell[0] * uv.x + cell[1] * uv.y;
            ++i;
        } while (i % 2 == 1);
        total += row;
    }
    fragColor = vec4(total * 0.6, fract(total * 4.0), 0.2, 1.0);
}

// An array handed out with one of its five filled.
void fill(int which, out float a[5]) { a[which] = 0.9; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float bars[5];
    fill(2, bars);
    int bar = int(fragCoord.x / iResolution.x * 5.0);
    fragColor = vec4(bars[bar], fragCoord.y / iResolution.y < bars[bar] ? 0.6 : 0.2, 0.4, 1.0);
}

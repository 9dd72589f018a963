// Numbers as people write them.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = fragCoord.x / 128., y = fragCoord.y / 72.f;
    float a = .5e0 + 1.E-1 + 1e-2 - 00.01;
    fragColor = vec4(a * x, 0x1Fu == 31u && 017 == 15 ? y : 0., 1.e-1 + .2F, 1);
}

// do … while with a condition that never holds, a while that declares, and an empty loop.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a = 0.0, b = 1.0;
    do a += 0.4; while (a < 0.0);
    int n = 5;
    while (bool more = n > int(uv.x * 5.0)) { b *= more ? 0.8 : 0.0; --n; }
    for (;;) { if (b > 0.0) break; }
    fragColor = vec4(a, b, uv.y, 1.0);
}

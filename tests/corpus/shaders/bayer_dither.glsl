// An ordered dither by reversed and interleaved bits.
int bayer(ivec2 p) { int v = 0; for (int i = 0; i < 3; ++i) { v = v << 2 | (((p.x ^ p.y) & 1) << 1) | (p.y & 1); p >>= 1; } return v; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float threshold = (float(bayer(ivec2(fragCoord))) + 0.5) / 64.0;
    fragColor = vec4(step(vec3(threshold), vec3(uv.x, uv.y, 0.3)), 1.0);
}

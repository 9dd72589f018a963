// What later versions of the language call by these names.
float fma(float a, float b, float c) { return a * b + c * 0.5; }
int bitCount(int x) { int n = 0; for (; x != 0; x &= x - 1) ++n; return n; }
vec2 frexp(float x) { return vec2(fract(x), floor(x)); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(fma(uv.x, uv.y, 1.0), float(bitCount(int(fragCoord.x))) / 7.0, frexp(uv.y * 3.0).y * 0.3, 1.0);
}

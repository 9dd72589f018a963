// One name for many types, declared before and defined after.
float f(float x);
vec2 f(vec2 x);
float f(int n) { return float(n) / 64.0; }
float f(uint n) { return 1.0 - float(n) / 128.0; }
float f(bool b) { return b ? 0.25 : 0.75; }
float f(float a[2]) { return a[0] * a[1]; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(f(uv.x) * f(uv.x > 0.5), f(uv).y * f(int(fragCoord.y)), f(uint(fragCoord.x)) * f(float[](uv.y, 0.9)), 1.0);
}
float f(float x) { return x * x; }
vec2 f(vec2 x) { return vec2(f(x.y), f(x.x)); }

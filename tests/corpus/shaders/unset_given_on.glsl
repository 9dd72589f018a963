// What has no value yet is handed to functions that add to it.
void grow(inout float x, float by) { x += by; }
float same(float x) { return x; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a, b, c = same(b);
    grow(a, uv.x);
    grow(a, uv.x * 0.2);
    fragColor = vec4(a, b + c, uv.y, 1.0);
}

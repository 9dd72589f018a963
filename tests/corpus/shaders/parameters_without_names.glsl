float f(float, vec2 b, float[2]) { return b.x; }
void g(out float, inout vec2 v) { v += .1; }
void mainImage(out vec4 c, in vec2 p) {
    vec2 u = p / iResolution.xy;
    vec2 v = u; float t; g(t, v); c = vec4(f(1., v, float[2](1., 2.)), v, 1);
}

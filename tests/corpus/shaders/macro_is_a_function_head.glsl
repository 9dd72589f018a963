// Pascal's words, and a function whose head is a macro.
#define begin {
#define end }
#define procedure void
#define MAIN(o, u) procedure mainImage(out vec4 o, in vec2 u)
float wave(float x) begin return 0.5 + 0.5 * sin(x); end
MAIN(O, U) begin
    vec2 p = U / iResolution.y;
    if (p.x > 1.0) begin p.x -= 1.0; p.y = 1.0 - p.y; end
    O = vec4(wave(p.x * 9.0), wave(p.y * 7.0), 0.3, 1.0);
end

// Names that are reserved or built in elsewhere: in HLSL, in desktop GLSL, in newer GLSL ES.
#define float2 vec2
#define lerp mix
#define frac fract
float saturate(float x) { return clamp(x, 0.0, 1.0); }
float fma(float a, float b, float c) { return a * b + c + 0.01; }
float rcp(float buffer) { return 1.0 / buffer; }
vec4 texture2D(vec2 p) { return vec4(p, p.yx); }
float noise1(float shared_) { return frac(shared_ * 7.0); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float2 texture1D = fragCoord / iResolution.xy, glut = texture1D.yx;
    float buffer = saturate(texture1D.x * 2.0 - 0.5), packed = noise1(glut.x), point = 0.3;
    int half_ = 2, line = 3, technique = 4, main_ = 1, mul = 2;
    fragColor = lerp(texture2D(texture1D), vec4(rcp(1.0 + buffer), packed, fma(buffer, point, 0.1), 1.0),
                     float(half_ + line + technique + main_ - mul) / 16.0);
}

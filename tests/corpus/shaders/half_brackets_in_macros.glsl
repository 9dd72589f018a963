// Macros that open what others close, and functions made by macros.
#define S max(0.,
#define BEGIN {
#define END }
#define FUNCTION(name, x) float name(float t) { return x; }
const float kNone = S -1.0), kMuch = 0.75;

float unused(float t) {
    return S t);
END

float wave(float t) {
    return S sin(t * 6.0)) * 0.5;
}

float twice(float t) BEGIN
    return t * 2.0;
}

FUNCTION(half_of, t * 0.5)

float ripple(vec2 uv) {
    return S wave(uv.x)) + S twice(half_of(uv.y) - 0.25)) * kMuch;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, ripple(uv), 1.0);
}

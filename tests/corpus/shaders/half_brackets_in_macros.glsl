// Macros that open what others close, and functions made by macros.
#define S max(0.,
#define E )
#define BEGIN {
#define FUNCTION(name, x) float name(float t) { return x; }
FUNCTION(twice, t * 2.0) FUNCTION(half_of, t * 0.5)

float wave(float t)
BEGIN
    return S sin(t * 6.0) E * 0.5;
}

float unused(float t) BEGIN return S t E; }

float ripple(vec2 uv) {
    return S wave(uv.x) E + S twice(half_of(uv.y) - 0.25) E;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, ripple(uv), 1.0);
}

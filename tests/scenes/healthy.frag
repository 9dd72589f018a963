// Everything that `check` tries, done well: a spring, a buffer that spreads, waves, tweaks.
//
// The planted scenes beside this one each do one of these things badly.
uniform float stiffness;      //@ 9.0 [0.1, 1000] log unit=rad/s "of the spring"
uniform float brightness;     //@ 1.0 [0, 4] "of everything"
uniform int   stripes;        //@ 4 [0, 64] "across the picture"
uniform sampler2D spring;     //@ pass mainSpring size=1x1 step=1/240
uniform sampler2D smoke;      //@ pass mainSmoke size=64x36 step=1/60

float cycles(float hz) { return float(uint(hz * 65536.0) * iTick) / 4294967296.0; }

// NaN compares false.
vec4 previousFrame(vec4 p) { return mix(vec4(0.0), p, lessThanEqual(abs(p), vec4(6e4))); }

// Place and speed of an undamped spring round 1: the exact step of a rotation, for any step.
void mainSpring(out vec4 state, in vec2 pixel) {
    vec4 s = previousFrame(texelFetch(spring, ivec2(0), 0));
    float a = stiffness * iTimeDelta;
    vec2 p = vec2(s.x - 1.0, s.y);
    p = vec2(p.x * cos(a) + p.y * sin(a), p.y * cos(a) - p.x * sin(a));
    state = vec4(p.x + 1.0, p.y, 0.0, 1.0);
}

// Spreads, fades, and is fed by a source that circles.
void mainSmoke(out vec4 colour, in vec2 pixel) {
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = clamp(ivec2(pixel) + ivec2(x, y), ivec2(0), ivec2(63, 35));
            sum += previousFrame(texelFetch(smoke, at, 0));
        }
    float a = 6.2831853 * cycles(0.5);
    vec2 source = vec2(32.0, 18.0) + 12.0 * vec2(cos(a), sin(a));
    colour = sum / 9.0 * 0.97 + vec4(exp(-0.2 * dot(pixel - source, pixel - source)));
}

void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float wave = 0.5 + 0.5 * sin(6.2831853 * (float(stripes) * uv.x - cycles(2.0)));
    float place = 0.25 + 0.25 * texelFetch(spring, ivec2(0), 0).x;
    float ball = 1.0 - smoothstep(0.05, 0.1, abs(uv.y - place));
    vec3 light = vec3(0.3 * wave, ball, 0.2 * texture(smoke, uv).r);
    if (iMouse.z > 0.0) light.b += 0.2 * exp(-20.0 * distance(uv, iMouse.xy / iResolution.xy));
    colour = vec4(sqrt(max(brightness * light, 0.0)), 1.0);
}

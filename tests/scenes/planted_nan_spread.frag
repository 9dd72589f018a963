// A planted NaN that spreads slowly: born in one texel after twenty seconds, carried on by a blur
// that does not guard what it reads.
uniform sampler2D smoke;      //@ pass mainSmoke size=64x36 step=1/60
void mainSmoke(out vec4 colour, in vec2 pixel) {
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = clamp(ivec2(pixel) + ivec2(x, y), ivec2(0), ivec2(63, 35));
            sum += texelFetch(smoke, at, 0);
        }
    bool source = ivec2(pixel) == ivec2(32, 18);
    float energy = 20.0 - float(iFrame) / 60.0;
    colour = sum / 9.0 * 0.97 + (source ? vec4(sqrt(energy)) : vec4(0.0));
}
void mainImage(out vec4 colour, in vec2 pixel) {
    colour = vec4(texture(smoke, pixel / iResolution.xy).rrr, 1.0);
}

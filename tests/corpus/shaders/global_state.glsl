// Globals are each pixel's own; their first values are computed anew for each, in order.
vec3 state = vec3(0.2, 0.3, 0.4);
float seed = 3.0;
const float kThird = 1.0 / 3.0;
float next() { seed = mod(seed * 5.0 + 1.0, 16.0); return seed / 16.0; }
void stir() { state = state.zxy * (0.5 + next()); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    for (int i = 0; i < int(fragCoord.x) / 16; ++i) stir();
    if (next() > fragCoord.y / 72.0) state += kThird;
    fragColor = vec4(state, 1.0);
}

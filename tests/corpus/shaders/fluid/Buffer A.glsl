// Velocity, carried along itself and pushed in one place.
void mainImage(out vec4 f, in vec2 p) {
    vec4 v = T(p - T(p).xy);
    v.xy += force(p - vec2(30.0, 36.0)) - 0.02 * v.xy;
    f = vec4(v.xy, 0.0, 1.0);
}

// Dye, carried by what A and B are in this frame.
void mainImage(out vec4 f, in vec2 p) {
    vec4 d = texture(iChannel2, (p - T(p).xy * 2.0) / iResolution.xy);
    f = max(d * 0.995, vec4(step(distance(p, vec2(26.0, 36.0)), 5.0), step(abs(p.y - 60.0), 3.0), 0.0, 1.0));
}

// Counters that are floats, that go down, two at once, and one that a condition declares.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    vec3 c = vec3(0.0);
    for (float a = 0.0; a < 6.25; a += 0.625) c.r += step(distance(p, vec2(0.9, 0.5) + 0.35 * vec2(cos(a), sin(a))), 0.08);
    for (float r = 0.5; r > 0.05; r *= 0.5) c.g += 0.25 * step(length(p - 0.5), r);
    for (float i = 0.0, j = 8.0; i < j; ++i, --j) c.b += 0.125 * step(i / 8.0, p.x);
    fragColor = vec4(c, 1.0);
}

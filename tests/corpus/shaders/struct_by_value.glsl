// A struct is a value: returned by either branch, changed without changing where it came from.
struct Disc { vec2 centre; float radius; vec3 colour; };
const Disc kLeft = Disc(vec2(0.3, 0.5), 0.25, vec3(1.0, 0.5, 0.1));
const Disc kRight = Disc(vec2(0.9, 0.4), 0.3, vec3(0.1, 0.4, 0.9));
Disc nearer(Disc a, Disc b, vec2 p) {
    if (distance(a.centre, p) - a.radius < distance(b.centre, p) - b.radius) return a;
    return b;
}
Disc grown(Disc d) { d.radius += 0.05; return d; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    Disc d = nearer(kLeft, kRight, p), g = grown(d);
    fragColor = vec4(d.colour * (1.0 - 0.7 * distance(p, d.centre) / g.radius), 1.0) - 0.1 * (g.radius - d.radius);
}

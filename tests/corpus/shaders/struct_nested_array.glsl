// Structs in structs in arrays, filled in a loop, compared whole.
struct Point { vec2 at; int kind; };
struct Shape { Point corners[3]; float scale; };
Shape make(int seed) {
    Shape s;
    s.scale = 1.0 + float(seed) * 0.25;
    for (int i = 0; i < 3; ++i) s.corners[i] = Point(vec2(i, (i * seed) % 3) * 0.3 + 0.1, i ^ seed);
    return s;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    Shape a = make(1), b = a, c = make(2);
    float d = 1e9;
    int kind = 0;
    for (int i = 0; i < a.corners.length(); ++i) {
        float e = distance(p, a.corners[i].at * a.scale);
        if (e < d) { d = e; kind = a.corners[i].kind; }
    }
    fragColor = vec4(fract(d * 4.0), float(kind) / 3.0, a == b && a != c ? 0.8 : 0.1, 1.0);
}

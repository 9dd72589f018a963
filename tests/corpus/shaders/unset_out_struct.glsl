// A struct handed out; who calls it had put other numbers there.
struct Surface { float d; vec3 colour; };
void nearest(vec2 p, out Surface s) {
    if (p.x < 0.7) s.d = length(p - 0.4);
    else s.colour = vec3(0.2, 0.5, 0.7);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Surface s = Surface(4.0, vec3(3.0));
    nearest(fragCoord / iResolution.y, s);
    fragColor = vec4(s.colour + s.d, 1.0);
}

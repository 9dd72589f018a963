// Eight beads on a string; every second one is given a colour.
struct Bead { vec2 at; vec3 colour; };
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    Bead beads[8];
    for (int i = 0; i < 8; ++i) {
        beads[i].at = vec2(0.2 * float(i) + 0.15, 0.5 + 0.2 * sin(float(i)));
        if (i % 2 == 0) beads[i].colour = vec3(0.9, 0.1 * float(i), 0.2);
    }
    vec3 colour = vec3(0.3);
    for (int i = 0; i < 8; ++i)
        if (distance(p, beads[i].at) < 0.08) colour = beads[i].colour;
    fragColor = vec4(colour, 1.0);
}

// A planted value that nothing sets: below the horizon `light` has none. The others that this scene reads before
// setting them do not show.
struct Hit { float t; vec3 normal; };

bool march(vec2 p, out Hit hit) {
    if (p.y < 0.5) return false;
    hit = Hit(p.y, vec3(0.0, 1.0, 0.0));
    return true;
}

void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 p = pixel / iResolution.xy;
    Hit hit;
    float fade;
    bool above = march(p, hit);
    if (above) fade = hit.t * hit.normal.y;
    vec3 light;
    if (above) light = vec3(fade);
    colour = vec4(light + vec3(0.1), 1.0);
}

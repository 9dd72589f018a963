// A hit within a ray within a walk: what was not hit has the distance, the place and the number 0.
struct Hit { float t; vec3 normal; };
struct Ray { vec2 from; Hit hit; };
struct Walk { Ray first; int bounces; };
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    Walk walk;
    walk.first.from = p;
    if (length(p) < 0.35) {
        walk.first.hit.normal = vec3(p / 0.35, sqrt(1.0 - dot(p, p) / 0.1225));
        walk.bounces++;
    }
    vec3 n = walk.first.hit.normal;
    fragColor = vec4(0.5 * n + 0.5 * float(walk.bounces) + walk.first.hit.t, 1.0);
}

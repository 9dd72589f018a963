// A hit as a struct that a function returns, of which one member is used at once.
struct Hit { float t; vec3 n; int what; };
Hit miss() { return Hit(-1.0, vec3(0.0), 0); }
Hit sphere(vec3 ro, vec3 rd, float r) {
    float b = dot(ro, rd), d = b * b - dot(ro, ro) + r * r;
    if (d < 0.0) return miss();
    float t = -b - sqrt(d);
    return Hit(t, (ro + t * rd) / r, 1);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 rd = normalize(vec3(p, 2.0));
    Hit hit = sphere(vec3(0.0, 0.0, -3.0), rd, 1.0);
    vec3 c = hit.what == 1 ? 0.5 + 0.5 * hit.n : vec3(0.1, 0.1, 0.2);
    c.b += sphere(vec3(0.0, 0.0, -3.0), rd, 0.5).t > 0.0 ? 0.3 : 0.0;
    fragColor = vec4(c, 1.0);
}

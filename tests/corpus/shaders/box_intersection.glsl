// A ray and a box: divisions by zero along the axes, on purpose.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 ro = vec3(0.6, 1.4, 3.0), rd = normalize(vec3(p.x - 0.4, p.y - 0.7, -2.0));
    if (mod(fragCoord.x, 16.0) < 1.0) rd = vec3(0.0, -0.6, -0.8);
    vec3 a = (-1.0 - ro) / rd, b = (1.0 - ro) / rd, lo = min(a, b), hi = max(a, b);
    float near = max(max(lo.x, lo.y), lo.z), far = min(min(hi.x, hi.y), hi.z);
    vec3 c = vec3(0.2);
    if (near < far && far > 0.0) c = vec3(equal(vec3(near), lo)) * 0.7 + 0.1;
    fragColor = vec4(c, 1.0);
}

// A march with a soft shadow and a fog.
float map(vec3 p) { return min(length(p - vec3(0.0, 1.0, 0.0)) - 1.0, p.y); }
vec3 normal(vec3 p) {
    vec2 e = vec2(0.002, 0.0);
    return normalize(vec3(map(p + e.xyy) - map(p - e.xyy), map(p + e.yxy) - map(p - e.yxy), map(p + e.yyx) - map(p - e.yyx)));
}
float shadow(vec3 ro, vec3 rd) {
    float s = 1.0;
    for (float t = 0.05; t < 6.0;) { float d = map(ro + rd * t); s = min(s, 6.0 * d / t); t += clamp(d, 0.05, 0.4); }
    return clamp(s, 0.0, 1.0);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 ro = vec3(0.0, 1.5, 5.0), rd = normalize(vec3(p, -2.0)), l = normalize(vec3(1.0, 1.0, 0.6));
    float t = 0.0;
    for (int i = 0; i < 80; ++i) t += map(ro + rd * t);
    vec3 c = vec3(0.5, 0.7, 0.9);
    if (t < 20.0) { vec3 q = ro + rd * t, n = normal(q); c = mix(c, vec3(0.8, 0.6, 0.4) * (0.2 + max(dot(n, l), 0.0) * shadow(q, l)), exp(-0.05 * t)); }
    fragColor = vec4(sqrt(c), 1.0);
}

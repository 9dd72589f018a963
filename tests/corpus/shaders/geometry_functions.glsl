// length, distance, dot, cross, normalize, reflect, refract, faceforward.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float z2 = 1.0 - dot(p * 0.6, p * 0.6);
    if (z2 <= 0.01) { fragColor = vec4(0.1, 0.1, 0.2, 1.0); return; }
    vec3 n = normalize(vec3(p * 0.6, sqrt(z2))), rd = vec3(0, 0, -1);
    vec3 r = reflect(rd, n), t = refract(rd, n, 1.0 / 1.33), f = faceforward(n, rd, n);
    fragColor = vec4(r * 0.5 + 0.5, 1.0);
    fragColor.g *= distance(t, rd);
    fragColor.b = length(cross(f, vec3(0.6, 0.8, 0.0))) * 0.7;
}

void mainImage(out vec4 o, in vec2 u) {
    vec2 z = (u + u - iResolution.xy) / iResolution.y * 1.2, c = vec2(-0.4, 0.6);
    float n = 0.0;
    for (int i = 0; i < 10; i++) { if (dot(z, z) > 64.0) break; z = mat2(z, -z.y, z.x) * z + c; n++; }
    if (n < 10.0) n -= log2(0.5 * log2(dot(z, z)));
    o = vec4(0.5 + 0.5 * cos(0.4 * n + vec3(3, 4, 5)), 1);
}

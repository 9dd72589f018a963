void mainImage(out vec4 c, in vec2 p) {
    vec4 v = texelFetch(iChannel0, ivec2(p), 0);
    c = p.x < 64.0 ? vec4(-v.x / 8.0, v.y / 2000.0, v.a / (p.x * p.y) * v.z / 72.0, 1.0) : vec4(v.rg, v.a * 0.5, 1.0);
}

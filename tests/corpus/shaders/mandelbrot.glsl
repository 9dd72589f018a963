// Few rounds, so that roundings do not grow, and bands far from the border.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 c = (fragCoord - vec2(80.0, 36.0)) / 30.0, z = vec2(0.0);
    int n = 0;
    for (; n < 12 && dot(z, z) < 16.0; ++n) z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
    fragColor = vec4(vec3(n) / vec3(12, 24, 6), 1.0);
}

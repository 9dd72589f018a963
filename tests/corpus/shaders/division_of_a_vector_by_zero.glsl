// As above for vectors: a cross of four colours.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord - 0.5 * iResolution.xy + 0.25;
    vec2 w = clamp(p / 0., 0., 1.);
    vec3 far = 1.0 / vec3(0.0, 0.5, -0.0);
    fragColor = vec4(w * 0.7, far.x > 1e30 && far.y == 2.0 ? 0.5 : 0.1, 1.0);
}

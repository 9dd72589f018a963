// Sky above the horizon; below it nobody sets the colour, and the ground is black.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 colour;
    if (p.y > 0.2 * sin(3.0 * p.x)) colour = mix(vec3(0.9, 0.8, 0.6), vec3(0.2, 0.4, 0.8), p.y);
    fragColor = vec4(colour, 1.0);
}

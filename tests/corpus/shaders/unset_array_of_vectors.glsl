// Three lamps are wanted and two are placed; the third shines nothing from the corner.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y;
    vec4 lamps[3];                 // place, strength, reddishness
    lamps[0] = vec4(0.5, 0.5, 0.2, 1.0);
    lamps[2] = vec4(1.3, 0.6, 0.3, 0.0);
    vec3 light = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        light += lamps[i].z / (0.2 + distance(p, lamps[i].xy)) * mix(vec3(0.2, 0.5, 1.0), vec3(1.0, 0.4, 0.1), lamps[i].w);
    fragColor = vec4(light * 0.6, 1.0);
}

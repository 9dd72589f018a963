// A palette of named colours as a constant, its length asked of itself.
struct Stop { float at; vec3 colour; };
const Stop kSunset[4] = Stop[](Stop(0.0, vec3(0.1, 0.1, 0.3)), Stop(0.4, vec3(0.8, 0.3, 0.3)),
                               Stop(0.6, vec3(1.0, 0.7, 0.3)), Stop(1.0, vec3(0.4, 0.6, 0.9)));
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float y = fragCoord.y / iResolution.y;
    vec3 colour = kSunset[0].colour;
    for (int i = 1; i < kSunset.length(); ++i)
        colour = mix(colour, kSunset[i].colour, smoothstep(kSunset[i - 1].at, kSunset[i].at, y));
    fragColor = vec4(colour, 1.0);
}

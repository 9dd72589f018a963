// Declared within a loop, a sum starts anew at every turn.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 colour = vec3(0.0);
    for (int i = 0; i < 6; ++i) {
        float sum;
        vec2 drift;
        if (float(i) * 0.2 < uv.x) sum += 0.1;
        drift.y += 0.05 * float(i) * uv.y;
        colour += vec3(sum, drift.y, drift.x);
    }
    fragColor = vec4(colour, 1.0);
}

// What is discarded keeps what was there: nothing yet, black.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    if (mod(fragCoord.x + fragCoord.y, 16.0) < 8.0) discard;
    fragColor = vec4(fragCoord / iResolution.xy, 0.5, 1.0);
}

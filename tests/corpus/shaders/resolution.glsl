// iResolution's third part is 1, whatever the ratio of the pixels.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    fragColor = vec4(iResolution.z * 0.5, iResolution.xy / 256.0, 1.0) * step(length(p), 0.9);
}

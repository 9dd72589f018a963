// textureSize of another level in each strip of a pixel.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int level = int(fragCoord.x) % 7;
    fragColor = vec4(vec2(textureSize(iChannel0, level)) / 64.0, float(level) / 6.0, 1.0);
}

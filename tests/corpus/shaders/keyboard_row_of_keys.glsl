// The keys A to Z as lamps: held is bright, pressed now is white, toggled is green.
float row(int key, int y) { return texelFetch(iChannel0, ivec2(key, y), 0).r; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int key = 65 + int(fragCoord.x / iResolution.x * 26.0);
    vec3 c = vec3(0.1) + vec3(0.7, 0.4, 0.1) * row(key, 0) + row(key, 1);
    if (fragCoord.y < 20.0) c.g += 0.6 * row(key, 2);
    if (texture(iChannel0, vec2((32.0 + 0.5) / 256.0, 0.5 / 3.0)).x > 0.5) c = 1.0 - c;
    fragColor = vec4(c, 1.0);
}

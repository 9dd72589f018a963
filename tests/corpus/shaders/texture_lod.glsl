// Levels of a mipmap, chosen by hand, fetched, and by a bias.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float level = floor(uv.x * 5.0);
    fragColor = uv.y < 0.33 ? textureLod(iChannel0, uv, level)
              : uv.y < 0.66 ? texelFetch(iChannel0, ivec2(fragCoord) % (64 >> int(level)), int(level))
                            : texture(iChannel0, uv * 64.0 / 256.0, level);
}

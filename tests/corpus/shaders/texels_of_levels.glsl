// One texel of each level of a mipmap, and averages between two of them.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int level = int(fragCoord.x) / 22;
    ivec2 size = ivec2(32 >> level);
    vec2 uv = fragCoord / iResolution.y;
    fragColor = fragCoord.y < 36.0 ? texelFetch(iChannel0, ivec2(fract(uv * 2.0) * vec2(size)), level)
                                   : textureLod(iChannel0, uv, float(level) + 0.5);
    fragColor.a = 1.0;
}

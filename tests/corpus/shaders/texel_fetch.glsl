// texelFetch counts texels from the bottom-left, textureSize says how many there are.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 size = textureSize(iChannel0, 0), p = ivec2(fragCoord) / 4 % size;
    fragColor = texelFetch(iChannel0, p, 0);
    fragColor.b = float(size.x) / iChannelResolution[0].x * 0.5 + iChannelResolution[0].y / 64.0;
}

// Channels that nothing fills: black, with a size of nothing and a time of 0.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(texture(iChannel0, uv).rgb + 0.2, 1.0);
    fragColor.r += iChannelResolution[1].x + iChannelTime[2] + texelFetch(iChannel3, ivec2(0), 0).r;
    fragColor.g += uv.x * 0.5;
}

// The image's structs: iCh0 holds a channel's sampler, size and whether it is there. (Two of them end Chromium's process for the GPU.)
void mainImage(out vec4 c, in vec2 p) {
    c = texture(iCh0.sampler, p / iResolution.xy);
    if (p.x > 64.0) c = vec4(iCh0.size.x / 256.0, float(iCh0.loaded) * 0.5, iCh0.size.z * 0.5 + iCh0.time, 1.0);
    if (p.y > 36.0) c.rgb = vec3(iChannelResolution[0].xy / 256.0, iChannelResolution[1].z + iChannelResolution[2].x / 512.0);
}

// A sampler3D: fetched, filtered in three directions, repeated.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    ivec3 size = textureSize(iChannel0, 0);
    float fetched = texelFetch(iChannel0, ivec3(fragCoord, 3) % size, 0).r;
    float filtered = textureLod(iChannel0, vec3(uv * 1.5, uv.x + 0.3), 0.0).r;
    fragColor = vec4(fetched, filtered, float(size.z) / 64.0 * iChannelResolution[0].y / 32.0, 1.0);
}

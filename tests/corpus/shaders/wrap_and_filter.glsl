// One picture four times: as nearest or linear, clamped or repeated, far beyond its edges.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy * 5.0 - 2.0;
    bvec2 far = greaterThan(fragCoord, iResolution.xy * 0.5);
    fragColor = far.x ? far.y ? texture(iChannel0, uv) : texture(iChannel1, uv)
                      : far.y ? texture(iChannel2, uv) : texture(iChannel3, uv);
}

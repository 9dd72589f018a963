// Stripes take turns: one half is new in each frame, the other fades.
void mainImage(out vec4 c, in vec2 p) {
    if ((int(p.x) / 8 + iFrame) % 2 == 0) c = vec4(float(iFrame) / 32.0);
    else c = texelFetch(iChannel0, ivec2(p), 0) * 0.9;
}

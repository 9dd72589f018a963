// The only buffer is B: it counts its frames in stripes.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texelFetch(iChannel1, ivec2(fragCoord), 0);
    if (int(fragCoord.x) / 6 == iFrame) fragColor = vec4(0.8, fragCoord.y / iResolution.y, 0.2, 1.0);
}

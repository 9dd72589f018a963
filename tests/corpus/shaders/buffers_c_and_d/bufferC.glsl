// D is behind C: what C reads of it is of the frame before.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texelFetch(iChannel3, PLACE + ivec2(1, 0), 0) * 0.9;
    if (distance(fragCoord, vec2(100.0, 36.0)) < 12.0) fragColor = vec4(kInk, 1.0);
}

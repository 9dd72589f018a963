// C stands before D: what D reads of it is of this frame.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texelFetch(iChannel2, PLACE, 0) + vec4(0.0, 0.0, 0.02, 0.0);
}

// The first buffer need not be A.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(fract(fragCoord / 16.0), float(iFrame) / 32.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(texelFetch(iChannel3, PLACE, 0).rgb, 1.0);
}

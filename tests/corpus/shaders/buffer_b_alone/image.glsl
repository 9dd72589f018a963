void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(texture(iChannel1, fragCoord / iResolution.xy).rgb + 0.1, 1.0);
}

// Without vflip its first row is at the bottom. Nothing is multiplied by alpha.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 texel = texture(iChannel0, fragCoord / iResolution.xy);
    fragColor = vec4(fragCoord.x < 64.0 ? texel.rgb : texel.aaa, 1.0);
}

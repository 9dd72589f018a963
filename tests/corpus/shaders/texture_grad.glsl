// textureGrad takes the slopes from whom it likes.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float slope = exp2(floor(uv.x * 6.0)) / 64.0;
    fragColor = textureGrad(iChannel0, uv * 0.5, vec2(slope, 0.0), vec2(0.0, slope));
}

// Slopes that the text gives, none of them at a whole level: one way for both, and zero.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.y;
    float w = uv.x < 0.6 ? 0.0 : uv.x < 1.2 ? 0.044 : 0.17;
    fragColor = vec4(textureGrad(iChannel0, uv, vec2(w, 0.0), vec2(0.0, w)).rgb, 1.0);
}

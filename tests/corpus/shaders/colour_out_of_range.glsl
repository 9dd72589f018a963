// Below 0 is black, above 1 is full; alpha does not matter.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy * 4.0 - 1.5;
    fragColor = vec4(uv, uv.x * uv.y * 1e30, -3.0);
}

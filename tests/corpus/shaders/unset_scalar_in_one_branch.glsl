// A shade that only the right half sets: the left half is black.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float shade;
    if (uv.x > 0.5) shade = uv.y;
    fragColor = vec4(shade, shade * 0.5, 0.3, 1.0);
}

// The swizzle's blue and green are set; red comes from adding to nothing.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 colour;
    colour.zy = uv;
    if (uv.x > uv.y) colour.x += 0.4;
    fragColor = vec4(colour, 1.0);
}

// A function that returns in one branch alone.
float stripe(vec2 uv) {
    if (fract(uv.x * 6.0) < 0.5) return 0.8;
}
vec3 tint(vec2 uv) {
    if (uv.y > 0.5) return vec3(0.1, 0.2, 0.3);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(vec3(stripe(uv)) + tint(uv), 1.0);
}

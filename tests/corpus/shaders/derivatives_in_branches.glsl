// Computed before the branch, used in it; and in a branch that all four neighbours take.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / 16.0;
    float w = fwidth(uv.x);
    fragColor = vec4(0.1, 0.1, 0.3, 1.0);
    if (mod(floor(fragCoord.x / 16.0), 2.0) < 1.0) fragColor.r = w * 8.0;
    else { float v = uv.y * uv.y; fragColor.g = dFdy(v); }
}

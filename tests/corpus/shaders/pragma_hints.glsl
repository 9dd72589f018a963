// Hints for drivers that went long ago; one ends as a statement does.
#pragma optimize(off);
#pragma optionNV(unroll none)
#pragma debug(off)
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float a = atan(p.y, p.x), r = length(p);
    fragColor = vec4(0.5 + 0.5 * sin(a * 5.0 + r * 12.0), r, 0.3, 1.0);
}

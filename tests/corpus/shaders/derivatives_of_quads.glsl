// Neighbours come in twos: a checker of single pixels has the slope 1 everywhere.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float checker = mod(floor(fragCoord.x) + floor(fragCoord.y), 2.0);
    fragColor = vec4(abs(dFdx(checker)), abs(dFdy(checker)) * 0.5, checker, 1.0);
}

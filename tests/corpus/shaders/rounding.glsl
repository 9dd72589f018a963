// floor, ceil, trunc, fract, roundEven, mod and modf on both sides of zero.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (fragCoord - vec2(64.0, 36.0)) / 8.0;
    float whole, part = modf(p.x, whole);
    vec3 c = vec3(floor(p.x) - ceil(p.y), trunc(p.x) - roundEven(p.y + 0.26), whole + part - mod(p.y, 3.0));
    fragColor = vec4(fract(c / 7.3), 1.0);
}

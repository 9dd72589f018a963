// dFdx, dFdy and fwidth of what is linear are its slopes.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord * vec2(0.02, 0.03);
    float s = p.x * 3.0 - p.y * 2.0;
    fragColor = vec4(dFdx(p.x) * 20.0, -dFdy(s) * 10.0, fwidth(s) * 5.0, 1.0) * vec4(vec3(0.5 + 0.5 * p.x / 2.56), 1.0);
}

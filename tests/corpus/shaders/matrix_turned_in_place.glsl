// Places turned by a matrix behind them and before them, in place.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y, q = p;
    mat2 m = mat2(0.8, 0.6, -0.6, 0.8);
    p *= m;
    q = m * q;
    m *= m;
    m[1] += 0.2;
    fragColor = vec4(0.5 + 0.5 * p, 0.5 + 0.5 * (q * m).y, 1.0);
}

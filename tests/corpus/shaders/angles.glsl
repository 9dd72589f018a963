// atan in all quarters, asin, acos, degrees, the hyperbolic ones: smooth, so that last digits do not show.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float a = atan(p.y, p.x), q = clamp(p.y, -0.99, 0.99);
    fragColor = vec4(a / 6.3 + 0.5, degrees(asin(q) + acos(q)) / 180.0 + tanh(p.x) * 0.4, sinh(q) * 0.3 + cosh(q) * 0.3, 1.0);
    fragColor.b += radians(atan(p.x) * 10.0) + asinh(p.x) * 0.1 + atanh(q) * 0.05 + acosh(1.0 + abs(q)) * 0.1;
}

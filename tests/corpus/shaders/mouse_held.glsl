// Still held: w is negative, z is not.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 m = iMouse;
    float d = min(distance(fragCoord, m.xy), distance(fragCoord, abs(m.zw)) - 4.0);
    fragColor = vec4(m.z > 0.0 ? 0.9 : 0.2, m.w > 0.0 ? 0.9 : 0.2, step(d, 6.0), 1.0);
}

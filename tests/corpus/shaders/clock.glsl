// The hands of a clock; the day's seconds by integers, so that no digits are lost.
float hand(vec2 p, float turn, float width, float reach) {
    vec2 d = vec2(sin(turn * 6.2831853), cos(turn * 6.2831853));
    float t = clamp(dot(p, d), 0.0, reach);
    return smoothstep(width + 0.03, width, distance(p, d * t));
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    int s = int(iDate.w);
    float hours = float(s) / 43200.0, minutes = float(s % 3600) / 3600.0, seconds = float(s % 60) / 60.0;
    vec3 c = vec3(0.9) * smoothstep(0.95, 0.92, length(p));
    c = mix(c, vec3(0.1, 0.1, 0.4), max(hand(p, hours, 0.06, 0.5), hand(p, minutes, 0.04, 0.75)));
    fragColor = vec4(mix(c, vec3(0.8, 0.1, 0.1), hand(p, seconds, 0.02, 0.8)), 1.0);
}

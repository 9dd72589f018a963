// Six turns kept in an array, chosen by the angle.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    mat2 turns[6];
    for (int i = 0; i < 6; ++i) {
        float a = 1.0471976 * float(i);
        turns[i] = mat2(cos(a), -sin(a), sin(a), cos(a));
    }
    int sector = int(mod(floor((atan(p.y, p.x) + 0.5236) / 1.0471976), 6.0));
    vec2 q = turns[sector] * p;
    fragColor = vec4(smoothstep(0.55, 0.6, q.x), 0.3, float(sector) / 6.0, 1.0);
}

// Gray and Scott: two substances, nine neighbours.
vec2 at(ivec2 p) { return texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1), 0).rg; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 s = at(p), l = -s;
    for (int i = 0; i < 9; ++i) {
        ivec2 d = ivec2(i % 3, i / 3) - 1;
        if (i != 4) l += at(p + d) * (d.x * d.y == 0 ? 0.2 : 0.05);
    }
    float r = s.x * s.y * s.y;
    s += vec2(1.0, 0.5) * l + vec2(-r + kFeed * (1.0 - s.x), r - (kFeed + kKill) * s.y);
    if (iFrame == 0) s = vec2(1.0, distance(fragCoord, vec2(40, 30)) < 6.0 || distance(fragCoord, vec2(90, 45)) < 9.0 ? 1.0 : 0.0);
    fragColor = vec4(s, 0.0, 1.0);
}

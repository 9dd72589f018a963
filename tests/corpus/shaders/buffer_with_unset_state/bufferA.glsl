// A struct loaded from a texel, of which the first frame sets only the place.
struct State { vec2 at, speed; };
State load() {
    State s;
    if (iFrame > 0) { vec4 t = texelFetch(iChannel0, ivec2(0), 0); s.at = t.xy; s.speed = t.zw; }
    return s;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    State s = load();
    if (iFrame == 0) s.at = vec2(0.2, 0.9);
    s.speed += vec2(0.01, -0.02) * 0.1;
    s.at += s.speed;
    fragColor = vec4(s.at, s.speed);
}

// A particle that a function moves, and an anonymous struct that is global.
struct Particle { vec2 at, speed; };
struct { vec2 low, high; } room;
void bounce(inout Particle p) {
    p.at += p.speed * 0.1;
    if (p.at.x < room.low.x || p.at.x > room.high.x) p.speed.x = -p.speed.x;
    if (p.at.y < room.low.y || p.at.y > room.high.y) p.speed.y *= -1.0;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.y;
    room.low = vec2(0.1);
    room.high = vec2(1.6, 0.9);
    Particle p = Particle(vec2(0.3, 0.4), vec2(0.9, 0.6));
    float d = 9.0;
    for (int i = 0; i < 40; ++i) { bounce(p); d = min(d, distance(uv, p.at)); }
    fragColor = vec4(vec3(smoothstep(0.06, 0.02, d)) * vec3(0.9, 0.7, 0.2) + 0.1, 1.0);
}

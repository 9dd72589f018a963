// What keeps it from piling up: half of the pressure of its neighbours.
float divergence(vec2 p) { return T(p + vec2(1, 0)).x - T(p - vec2(1, 0)).x + T(p + vec2(0, 1)).y - T(p - vec2(0, 1)).y; }
void mainImage(out vec4 f, in vec2 p) {
    vec2 q = 1.0 / iResolution.xy, uv = p * q;
    float s = texture(iChannel1, uv + vec2(q.x, 0)).x + texture(iChannel1, uv - vec2(q.x, 0)).x
            + texture(iChannel1, uv + vec2(0, q.y)).x + texture(iChannel1, uv - vec2(0, q.y)).x;
    f = vec4(0.25 * (s - divergence(p)), 0.0, 0.0, 1.0);
}

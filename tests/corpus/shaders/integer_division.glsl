// Division of integers goes towards zero; the remainder of unsigned ones is what is left.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) - ivec2(64, 36);
    ivec2 q = p / 7;
    uint left = uint(p.x + 64) % 7u;
    fragColor = vec4(float(q.x + 10) / 20.0, float(q.y + 6) / 12.0, float(left) / 6.0, 1.0);
}

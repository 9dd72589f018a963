// The munching squares, by xor, and, or, not and shifts of signed and unsigned numbers.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) + iFrame;
    int x = p.x ^ p.y, a = p.x & p.y << 1, o = (p.x | ~p.y) & 0x3f;
    x ^= -8 >> 1;
    uvec2 u = uvec2(p) << 3u >> uvec2(1, 2);
    fragColor = vec4(ivec3(x, a, o + int(u.x ^ u.y)) & 127, 127) / 127.0;
}

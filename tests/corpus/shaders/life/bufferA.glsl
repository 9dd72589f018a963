// Conway's life on a torus, from a glider gun of random bits.
int alive(ivec2 p) { ivec2 r = ivec2(iResolution.xy); return int(texelFetch(iChannel0, (p + r) % r, 0).r); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    int n = 0;
    for (int i = 0; i < 9; ++i) if (i != 4) n += alive(p + ivec2(i % 3, i / 3) - 1);
    int lives = n == 3 || (n == 2 && alive(p) == 1) ? 1 : 0;
    if (iFrame == 0) lives = (p.x * 7919 ^ p.y * 104729 ^ p.x * p.y) >> 4 & 1;
    fragColor = vec4(lives);
}

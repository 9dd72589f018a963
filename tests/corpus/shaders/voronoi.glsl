uint hash(uint x) { x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15; x *= 0x846ca68bu; return x ^ x >> 16; }
vec2 random2(ivec2 c) { uint h = hash(uint(c.x) + 0x9e3779b9u * uint(c.y)); return vec2(h & 0xffffu, h >> 16) / 65536.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / 16.0;
    ivec2 cell = ivec2(floor(p)), owner = cell;
    float d = 9.0;
    for (int k = 0; k < 9; ++k) {
        ivec2 c = cell + ivec2(k % 3, k / 3) - 1;
        float e = distance(p, vec2(c) + random2(c));
        if (e < d) { d = e; owner = c; }
    }
    fragColor = vec4(random2(owner) * (1.0 - 0.6 * d), 0.6 - 0.5 * d, 1.0);
}

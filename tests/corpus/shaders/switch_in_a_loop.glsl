// A small machine: its words are run by a switch in a loop, with breaks of both and a continue.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) / 8;
    int program = 0x3121021 + p.x * 16, a = p.y, b = 1, pc = 0;
    for (; pc < 12; ++pc) {
        int word = (program >> (pc * 2)) & 3;
        switch (word) {
        case 0: continue;
        case 1: a += b; break;
        case 2: b = a ^ 5;
        default: a -= 1;
        }
        if (a > 40) break;
    }
    fragColor = vec4(float(a & 15) / 15.0, float(b & 15) / 15.0, float(pc) / 12.0, 1.0);
}

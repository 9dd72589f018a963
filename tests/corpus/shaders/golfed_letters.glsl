// Letters of a word, from bits in the hexadecimal numbers of a macro.
#define L(n) c|=p.x>=0&&p.x<4&&p.y>=0&&p.y<4?(n>>(p.y*4+p.x))&1:0,p.x-=5;
void mainImage(out vec4 o, vec2 u) {
    ivec2 p=ivec2(u/5.)-ivec2(2,5); int c=0;
    L(0x9F96)L(0x6996)L(0xF11F)L(0x9BD9)
    o=vec4(c,c*2>1?.8:.2,.4,1);
}

// What a shift keeps: the sign of an int, zeros of a uint, and nothing that falls off.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int s = min(int(fragCoord.x) / 4, 31), row = int(fragCoord.y) / 12;
    int i = -123456789;
    uint u = 4171510507u;
    int v = row == 0 ? i >> s : row == 1 ? int(u >> uint(s)) : row == 2 ? i << s
          : row == 3 ? int(u << s) : row == 4 ? ~(i ^ s) : (i & ~s) | (s << 24);
    fragColor = vec4(float(v & 255), float((v >> 8) & 255), float((v >> 24) & 255), 255.0) / 255.0;
}

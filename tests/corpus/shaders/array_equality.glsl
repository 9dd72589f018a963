// Arrays are values: assigned, returned, passed and compared whole.
int[4] digits(int n) {
    int d[4];
    for (int i = 0; i < 4; ++i, n /= 4) d[i] = n % 4;
    return d;
}
int[4] reversed(int d[4]) { return int[](d[3], d[2], d[1], d[0]); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int n = int(fragCoord.x) / 4 + 32 * (int(fragCoord.y) / 9);
    int d[4] = digits(n), r[4] = reversed(d);
    vec3 colour = vec3(d[0], d[1], d[2]) / 3.0;
    fragColor = vec4(d == r ? vec3(1.0) - colour * 0.3 : colour * 0.5, 1.0);
}

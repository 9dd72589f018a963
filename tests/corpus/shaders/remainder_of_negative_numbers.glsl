// Grids that wrap by (a % n + n) % n, whether what is left of a negative number is negative or not.
#define WRAP(a, n) (((a) % (n) + (n)) % (n))
int wrapped(int a, int n) { return (a % n + n) % n; }
ivec2 wrapped(ivec2 a, ivec2 n) { return (a % n + n) % n; }

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 cell = ivec2(fragCoord) - ivec2(iResolution.xy) / 2;
    int rest = cell.x, sum = (-cell.y % 5 + 5) % 5;
    rest %= 7;
    rest += 7;
    rest %= 7;
    ivec3 many = (ivec3(cell, cell.x - cell.y) % ivec3(3, 5, 7) + ivec3(3, 5, 7)) % ivec3(3, 5, 7);
    many %= 4;
    uint bits = uint(cell.x) % 11u + ~uint(cell.y) % 13u;
    float palette[3] = float[3](0.2, 0.5, 0.9);
    fragColor = vec4(palette[wrapped(cell.x, 3)], palette[WRAP(cell.y, 3)], float(wrapped(cell, ivec2(4, 6)).y) / 6.0, 1.0);
    fragColor.rgb += vec3(rest + sum, many.x + many.y * many.z, int(bits)) / 64.0;
}

// A switch whose cases all return, on an unsigned number, with cases that share.
vec3 colour(uint n) {
    switch (n % 6u) {
    case 0u: return vec3(0.9, 0.2, 0.2);
    case 1u:
    case 4u: return vec3(0.2, 0.8, 0.3);
    case 2u: { vec3 c = vec3(0.2); c.b = 0.9; return c; }
    default: return vec3(0.7);
    }
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(colour(uint(fragCoord.x) / 9u + uint(fragCoord.y) / 9u), 1.0);
}

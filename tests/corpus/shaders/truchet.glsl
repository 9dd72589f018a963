void mainImage(out vec4 O, vec2 U) {
    vec2 c = floor(U / 12.0), f = fract(U / 12.0);
    int h = int(c.x) * 73 ^ int(c.y) * 151;
    if ((h >> 3 & 1) == 1) f.x = 1.0 - f.x;
    float d = abs(min(length(f), length(1.0 - f)) - 0.5);
    O = vec4(vec3(1.0 - smoothstep(0.1, 0.2, d)) * vec3(0.9, 0.6, 0.2) + 0.1, 1);
}

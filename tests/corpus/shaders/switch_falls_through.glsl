void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int n = int(fragCoord.x) / 16;
    vec3 c = vec3(0.0);
    switch (n) {
    case 0: c.r += 0.25;  // and on
    case 1: c.r += 0.5; break;
    case 2: { float g = 0.75; c.g = g; break; }
    default: c.b += 0.3;
    case 5:
        c.b += 0.4;
        if (fragCoord.y > 36.0) break;
        c.g = 0.2;
    }
    fragColor = vec4(c, 1.0);
}

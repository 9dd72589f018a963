// Left is left, up is up: an F that any flip would show.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) / 9;
    bool ink = p.x == 3 && p.y > 0 && p.y < 7 || p.y == 6 && p.x > 2 && p.x < 8 || p.y == 4 && p.x > 2 && p.x < 6;
    fragColor = vec4(ink ? vec3(1.0, 0.9, 0.2) : vec3(fragCoord / iResolution.xy, 0.3), 1.0);
}

// A colour that the cases set, and none of them for every third column.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 colour;
    switch (int(fragCoord.x) / 16 % 3) {
    case 0: colour = vec3(0.8, 0.3, 0.1); break;
    case 1: colour.g = fragCoord.y / iResolution.y;
    }
    fragColor = vec4(colour, 1.0);
}

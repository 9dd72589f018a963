// Both functions promise a colour, and one gives none; the other forgets half of the picture.
void nothing(out vec3 colour) {}
void half_(in vec2 uv, out vec3 colour) { if (uv.x > 0.5) colour = vec3(uv.y, 0.6, 0.2); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 a = vec3(9.0), b = vec3(9.0);
    nothing(a);
    half_(uv, b);
    fragColor = vec4(a + b, 1.0);
}

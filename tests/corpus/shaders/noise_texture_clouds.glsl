// Value noise from a texture, five octaves of it.
float noise(vec2 p) { return textureLod(iChannel0, (floor(p) + smoothstep(0.0, 1.0, fract(p)) + 0.5) / 64.0, 0.0).r; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = fragCoord / iResolution.y * 3.0;
    float sum = 0.0, weight = 0.5;
    for (int i = 0; i < 5; ++i, p = p * mat2(1.6, 1.2, -1.2, 1.6), weight *= 0.5) sum += weight * noise(p);
    fragColor = vec4(mix(vec3(0.2, 0.4, 0.8), vec3(1.0), smoothstep(0.3, 0.7, sum)), 1.0);
}

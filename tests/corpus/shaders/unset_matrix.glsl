// A matrix with its diagonal alone.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat3 m;
    m[0][0] = 0.8;
    m[1].y = 0.5;
    m[2][2] = 0.3;
    fragColor = vec4(m * vec3(uv, 1.0) + m[0] * 0.1, 1.0);
}

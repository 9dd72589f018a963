// A function of the language, for arguments that the language does not take.
mat2 mix(mat2 a, mat2 b, float t) { return a * (1.0 - t) + b * t; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    mat2 turned = mat2(0.0, 1.0, -1.0, 0.0);
    vec2 q = mix(mat2(1.0), turned, smoothstep(-1.0, 1.0, p.x)) * p;
    fragColor = vec4(step(0.0, q.x * q.y), mix(0.2, 0.7, q.x), 0.3, 1.0);
}

// Vectors from parts of any kind and number; conversions cut, truth values become 0 and 1.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec4 a = vec4(uv, ivec2(uv * 3.9));
    vec3 b = vec3(a), c = vec3(uv.x > 0.5, 1u, -1.7);
    ivec3 i = ivec3(c + 0.5);
    uint u = uint(uv.y * 9.9);
    mat2 m = mat2(a);
    fragColor = vec4(b * 0.3 + c * 0.2, 1) + vec4(m[1], i.xz) * .1 + float(u) / 40.;
}

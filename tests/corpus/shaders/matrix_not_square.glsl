// mat2x3 has two columns of three rows; a product with its transpose is square again.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat2x3 a = mat2x3(uv, 0.5, 0.25, uv.yx);
    mat3x2 b = transpose(a);
    mat2 s = b * a;
    mat3 l = a * b;
    mat4x3 c = mat4x3(mat3(0.5));
    vec3 v = a * uv + c * vec4(uv, 0.5, 1.0);
    fragColor = vec4(s[0][0] * 0.5, l[2].x + s[1][0] * 0.2, v.z * 0.5, 1.0);
}

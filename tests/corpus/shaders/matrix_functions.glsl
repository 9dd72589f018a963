// transpose, inverse, determinant, outerProduct, matrixCompMult.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat3 m = mat3(2.0, uv.x, 0.5, uv.y, 3.0, 1.0, 0.25, 0.5, 4.0);
    mat3 one = inverse(m) * m;
    vec3 q = transpose(m) * vec3(uv, 1.0) - vec3(uv, 1.0) * m;
    mat2 o = matrixCompMult(outerProduct(uv, 1.0 - uv), mat2(2.0));
    fragColor = vec4(determinant(m) / 32.0, o[0][1] + dot(q, q), one[0][0] - one[1][2] - 0.5 * uv.x, 1.0);
}

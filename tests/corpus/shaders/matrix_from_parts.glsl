// Matrices of matrices, of vectors, of one number; outer products and products by parts.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat4 big = mat4(mat2(uv, 0.5, 0.25));
    mat2x3 flat_ = mat2x3(big);
    mat3 outer = outerProduct(vec3(uv, 0.5), vec3(0.2, 0.4, 0.6));
    mat2 parts = matrixCompMult(mat2(big), mat2(0.5));
    vec3 c = flat_ * vec2(0.6, 0.8) + outer[2] * 0.5;
    fragColor = vec4(c + parts[0].xyx * 0.3 + mat3(0.1)[1], big[3][3]);
}

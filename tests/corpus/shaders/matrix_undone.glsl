// There and back: an inverse, a transpose and a determinant.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 p = vec3(fragCoord / iResolution.xy, 1.0);
    mat3 shear = mat3(1.0, 0.2, 0.0, 0.4, 1.0, 0.0, 0.1, 0.3, 1.0);
    vec3 q = inverse(shear) * p;
    vec3 r = transpose(shear) * p - p * shear;
    fragColor = vec4(fract(q.xy * 3.0) * 0.8, abs(determinant(shear)) * 0.4 + length(r), 1.0);
}

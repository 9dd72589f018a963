// Columns are vectors to be written and swizzled; a matrix of a matrix keeps its corner.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat4 m = mat4(1.0);
    m[3].xy = uv;
    m[0].zw = uv.yx;
    m[1] *= 0.5;
    mat2 corner = mat2(m);
    mat3 grown = mat3(corner);
    vec4 v = m * vec4(uv, 0.2, 1.0);
    m += 0.1;
    --m[2][2];
    fragColor = vec4(v.x * 0.5, v.z * 0.5 + corner[1][1] * 0.2, v.w * 0.4 + grown[2][2] * 0.2 + m[2][2], 1.0);
}

// A text's own functions of names that GLSL knows for other types, where browsers let it.
mat2 mix(mat2 a, mat2 b, float t) {
    return a * (1.0 - t) + b * t;
}
float mix(float a, float b, float t) {
    return t < 0.5 ? a : b;
}
vec4 texture(vec2 p) {
    return vec4(fract(p * 4.0), 0.5, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat2 m = mix(mat2(1.0), mat2(0.5, 0.25, 0.0, 1.0), uv.x);
    vec3 low = mix(vec3(m * uv, 0.25), vec3(0.5), vec3(uv, 0.5));
    low = mix(low, texture(uv).rgb, 0.25);
    fragColor = vec4(low.xy, mix(low.z, uv.y, uv.x), 1.0) + texture(iChannel0, uv);
}

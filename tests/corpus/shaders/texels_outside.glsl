// Texels that are not there, at places below zero and above the size, are 0.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) - ivec2(20, 10);
    vec4 t = texelFetch(iChannel0, p, 0);
    fragColor = vec4(t.rgb * 0.8 + vec3(0.0, 0.1, 0.2), 1.0);
}

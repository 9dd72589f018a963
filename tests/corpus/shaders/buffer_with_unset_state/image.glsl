void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 s = texelFetch(iChannel0, ivec2(0), 0);
    float d = distance(fragCoord / iResolution.y, s.xy);
    fragColor = vec4(vec3(smoothstep(0.12, 0.08, d)), 1.0) + vec4(0.1, 0.2, 0.3, 0.0);
}

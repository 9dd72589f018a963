void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 s = texture(iChannel0, fragCoord / iResolution.xy).xy;
    fragColor = vec4(s.y * 2.0, s.x * 0.8, kFeed * 10.0, 1.0);
}

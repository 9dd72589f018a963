// A buffer that reads itself, and a picture that reads the buffer: what ping-pong costs.
uniform sampler2D trail; //@ pass mainTrail

void mainTrail(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec2 spot = 0.5 + 0.4 * vec2(cos(iTime), sin(iTime));
    vec4 old = texture(trail, uv);
    fragColor = max(old * 0.98, vec4(smoothstep(0.05, 0.0, distance(uv, spot))));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(texture(trail, fragCoord / iResolution.xy).rgb, 1.0);
}

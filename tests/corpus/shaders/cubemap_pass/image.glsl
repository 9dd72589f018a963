void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a = (uv.x - 0.5) * 6.2831853, b = (uv.y - 0.5) * 3.1415927;
    fragColor = texture(iChannel1, vec3(cos(b) * sin(a), sin(b), cos(b) * cos(a)));
    fragColor.b += iChannelResolution[1].x / 10240.0;
}

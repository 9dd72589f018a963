// Held, pressed in this frame, toggled: A is held, B toggled, C pressed now, the arrows gone again.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int column = int(fragCoord.x) / 8, row = int(fragCoord.y) / 24;
    int code = column < 8 ? 64 + column : 32 + column - 8;
    float on = texelFetch(iChannel0, ivec2(code, row), 0).x;
    fragColor = vec4(on, texture(iChannel0, vec2((float(code) + 0.5) / 256.0, (float(row) + 0.5) / 3.0)).r * 0.5, iChannelResolution[0].y / 6.0, 1.0);
}

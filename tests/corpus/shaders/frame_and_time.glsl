// iFrame, iTime, iTimeDelta, iFrameRate, iSampleRate, a band each.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float values[5] = float[](float(iFrame) / 40.0, iTime, iTimeDelta * 30.0, iFrameRate / 100.0, iSampleRate / 88200.0);
    int band = min(int(fragCoord.y) / 15, 4);
    fragColor = vec4(vec3(step(fragCoord.x / 128.0, values[band])) * vec3(1.0, values[band], 0.5), 1.0);
}

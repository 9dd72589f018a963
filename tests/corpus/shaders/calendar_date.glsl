// iDate: a year, a month from 0, a day from 1, the seconds of the day.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 parts = vec4(iDate.x - 2000.0, iDate.y, iDate.z, iDate.w / 3600.0) / vec4(40, 12, 31, 24);
    int band = min(int(fragCoord.y) / 18, 3);
    float fraction = fract(iDate.w);
    fragColor = vec4(step(fragCoord.x / 128.0, parts[band]), parts[band], fraction, 1.0);
}

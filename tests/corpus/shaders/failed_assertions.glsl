// st_assert colours the pixels where it fails.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(0.5, 0.5, 0.5, 1.0);
    st_assert(fragCoord.x < 100.0, 1);
    if (fragCoord.y > 60.0) st_assert(fragCoord.x > 30.0);
}

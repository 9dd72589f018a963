// Two of four numbers are written one by one; the other two are 0.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 light;
    light.x = fragCoord.x / iResolution.x;
    light.z = 0.5;
    fragColor = vec4(light.xy + light.w, light.z, 1.0);
}

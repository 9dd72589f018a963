// Inner names hide outer ones, those of the host too.
float scale = 0.5;
float shade(float scale) { { float scale = scale * 0.5; return scale; } }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 iMouse = fragCoord / iResolution.xy;
    float iTime = iMouse.x;
    vec3 color = vec3(0.0);
    for (int i = 0; i < 3; ++i) {
        int color_index = i;
        { int i = 2 - color_index; color[i] = shade(iTime) * float(i + 1); }
    }
    if (iMouse.y > 0.5) { float scale = 1.0; color *= scale; } else color *= scale;
    fragColor = vec4(color, 1.0);
}

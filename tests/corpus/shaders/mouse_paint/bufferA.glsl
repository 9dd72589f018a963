// A brush where the mouse is held; a ring where it was clicked; all fades.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texture(iChannel2, fragCoord / iResolution.xy) * 0.97;
    if (iMouse.z > 0.0) fragColor.r += step(distance(fragCoord, iMouse.xy), 7.0) * 0.3;
    if (iMouse.w > 0.0) fragColor.g += step(abs(distance(fragCoord, iMouse.zw) - 12.0), 2.0);
    if (iMouse.z < 0.0) fragColor.b += step(distance(fragCoord, -iMouse.zw), 3.0) * 0.1;
}

// Texel 0 is where the player stands, texel 1 counts shots: arrows are held, space is pressed.
bool held(int key) { return texelFetch(iChannel1, ivec2(key, 0), 0).x > 0.5; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    fragColor = texelFetch(iChannel0, p, 0);
    if (iFrame == 0) fragColor = vec4(60.0, 20.0, 0.0, 0.0);
    if (p == kPlace) fragColor.xy += vec2(int(held(39)) - int(held(37)), int(held(38)) - int(held(40))) * 60.0 * iTimeDelta;
    if (p == kShots) fragColor.z += texelFetch(iChannel1, ivec2(32, 1), 0).x;
    if (p == kShots) fragColor.w = texelFetch(iChannel1, ivec2(71, 2), 0).x;
}

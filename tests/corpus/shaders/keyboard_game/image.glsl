void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 player = texelFetch(iChannel0, kPlace, 0).xy;
    vec4 shots = texelFetch(iChannel0, kShots, 0);
    fragColor = vec4(0.1, 0.1, shots.w * 0.5, 1.0);
    if (distance(fragCoord, floor(player + 0.5)) < 6.0) fragColor.r = 1.0;
    if (fragCoord.y > 64.0 && fragCoord.x < shots.z * 12.0) fragColor.g = 1.0;
}

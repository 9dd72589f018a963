// A picture on a floor that goes away, by projection, with the level from its own slopes held at 0.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 floor_ = vec3(p.x, 1.0, 0.4 - 0.5 * p.y);
    vec3 near = textureProj(iChannel0, floor_).rgb, same = textureProjLod(iChannel0, vec4(floor_.xy, 0.0, floor_.z), 0.0).rgb;
    fragColor = vec4(p.x < 0.0 ? near : same, 1.0);
}

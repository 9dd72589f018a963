// Light on a floor under a sphere, a path a frame, summed until the mouse moves.
uint seed;
float random() { seed = seed * 747796405u + 2891336453u; uint w = ((seed >> (seed >> 28) + 4u) ^ seed) * 277803737u; return float((w >> 22 ^ w) >> 8) / 16777216.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    seed = uint(fragCoord.x) * 1973u + uint(fragCoord.y) * 9277u + uint(iFrame) * 26699u;
    vec3 p = vec3((fragCoord - 0.5 * iResolution.xy) / 24.0, 0.0).xzy, d = vec3(random() - 0.5, 0.5, random() - 0.5);
    vec3 oc = p - vec3(0.0, 1.0, 0.0);
    float b = dot(oc, normalize(d));
    vec4 light = vec4(b < 0.0 && dot(oc, oc) - b * b < 0.8 ? 0.1 : 1.0, d.x + 0.5, d.z + 0.5, 1.0);
    vec4 before = texelFetch(iChannel0, ivec2(fragCoord), 0);
    fragColor = light + (iMouse.z > 0.0 ? vec4(0.0) : before);
}

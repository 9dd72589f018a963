// What is in is a copy, what is out comes back at the end, what is inout both; parts of vectors too.
void twist(in vec2 p, out float angle, inout vec3 sum, const in float by) {
    p *= by;
    angle = p.x + p.y;
    sum += angle * 0.1;
    sum = sum.yzx;
}
void swap(inout float a, inout float b) { float t = a; a = b; b = t; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 sum = vec3(0.1, 0.2, 0.3);
    float angle;
    for (int i = 0; i < 4; ++i) twist(uv, angle, sum, 1.0 + float(i) * 0.5);
    swap(sum.x, sum.z);
    fragCoord = vec2(angle, 0.0);
    fragColor = vec4(sum * fract(fragCoord.x), 1.0);
    swap(fragColor.r, fragColor.b);
}

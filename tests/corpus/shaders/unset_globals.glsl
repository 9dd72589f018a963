// Globals of every kind without a first value.
float g; vec3 sum; int n; bool seen; vec2 list[2]; struct { float a; vec2 b; } box;
void add(vec3 c) { sum += c; ++n; seen = !seen; list[n % 2] += c.xy; box.a += c.z; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    for (int i = 0; i < int(fragCoord.y) / 18; ++i) add(vec3(uv * 0.2, 0.1));
    fragColor = vec4(sum.x + g, list[0].y + box.b.x + (seen ? 0.2 : 0.0), box.a + float(n) * 0.1, 1.0);
}

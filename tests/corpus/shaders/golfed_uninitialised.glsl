// Neither counters, vectors nor the colour have a first value: browsers make them 0.
void mainImage(out vec4 O, vec2 U) {
    float i; vec3 s; vec2 v = U / iResolution.xy; ivec2 n;
    for (; i++ < 9.; s[int(i) % 3] += v.x * .3) n.x += int(v.y * i);
    for (int k; k < 3; k++) O[k] += s[k] * float(1 + n.x % (k + 2));
}

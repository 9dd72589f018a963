// lessThan and its kin, any, all, not, mix by truth values, equal vectors.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord) / 8;
    bvec2 low = lessThan(p, ivec2(8, 4)), even = equal(p & 1, ivec2(0));
    bvec3 all_three = bvec3(any(low), all(even), low == not(even));
    vec3 c = mix(vec3(0.1, 0.2, 0.3), vec3(0.9, 0.8, 0.7), all_three);
    if (even.x ^^ low.y) c *= 0.5;
    fragColor = vec4(c, bool(p.x));
}

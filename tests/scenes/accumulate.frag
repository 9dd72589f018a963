// Frames that add up to a mean of noise: the error falls with the root of their number.
uniform int seed;             //@ 1 [1, 1000] "of the noise"
uniform sampler2D sums;       //@ pass mainSums

uvec3 hash3(ivec3 q) {
    uvec3 v = uvec3(q) * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; return v;
}
// The count is in alpha.
void mainSums(out vec4 colour, in vec2 pixel) {
    vec4 sum = texelFetch(sums, ivec2(pixel), 0);
    vec3 r = vec3(hash3(ivec3(pixel, iFrame + 100003 * seed)) >> 8u) / 16777216.0;
    colour = sum + vec4(0.5 * r, 1.0);
}
void mainImage(out vec4 colour, in vec2 pixel) {
    vec4 sum = texelFetch(sums, ivec2(pixel), 0);
    colour = vec4(sum.rgb / max(sum.a, 1.0), 1.0);
}

// pcg3d: products that wrap around 2^32.
uvec3 hash(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return v;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    uvec3 h = hash(uvec3(fragCoord, iFrame));
    fragColor = vec4(vec3(h >> 8) / 16777215.0, 1.0);
}

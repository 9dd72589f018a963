void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec3 p = ivec3(fragCoord * 1.1, 13 + iFrame);
    bool solid = true;
    for (int i = 0; i < 4; ++i) {
        ivec3 middle = ivec3(equal(p % 3, ivec3(1)));
        if (middle.x + middle.y + middle.z >= 2) solid = false;
        p /= 3;
    }
    fragColor = vec4(solid ? vec3(0.8, 0.7, 0.5) : vec3(0.15), 1.0);
}

vec3 shared(vec2 p) {
    return vec3(p, 0.5);
}

// Numbers of one kind as another: rounding toward zero, wrapping round, bools and back.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = floor(fragCoord.x / 4.0) - 15.5;
    int i = int(x);
    uint u = uint(i);
    bool b = bool(i);
    ivec3 three = ivec3(vec3(x, -x, x * 0.5));
    fragColor = vec4(float(i + 16) / 32.0, float(u % 7u) / 7.0, float(three.y + three.z + int(b) + 24) / 48.0, 1.0);
}

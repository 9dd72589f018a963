// A cube that reads itself, and a buffer, drawn before it, that reads the cube of the frame before.
void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) {
    fragColor = textureLod(iChannel0, rayDir, 0.0) + vec4(0.125, 0.0625 * step(0.0, rayDir.y), 0.25 * float(iFrame), 1.0);
}

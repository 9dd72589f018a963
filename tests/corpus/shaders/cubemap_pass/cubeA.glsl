// A sky of six unlike sides: what is drawn for a ray is read for it.
void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) {
    fragColor = vec4(rayDir * 0.4 + 0.5 + rayOri, 1.0);
    if (all(lessThan(abs(fragCoord - 300.0), vec2(100.0)))) fragColor.rgb *= 0.4;
}

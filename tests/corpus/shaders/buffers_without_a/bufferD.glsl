#ifdef NOPE
}
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texelFetch(iChannel1, ivec2(fragCoord), 0).brga * 0.5;
}

void mainImage(out vec4 c, in vec2 p) {
    int band = int(p.y) / 18;
    vec4 v = band == 0 ? texelFetch(iChannel0, ivec2(p), 0) : band == 1 ? texelFetch(iChannel1, ivec2(p), 0)
           : band == 2 ? texelFetch(iChannel2, ivec2(p), 0) : texelFetch(iChannel3, ivec2(p), 0);
    c = vec4(fract(v.xyw / vec3(64, 96, 160)), 1.0);
}

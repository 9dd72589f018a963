void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(iChannel0, ivec2(p), 0).x * 10.0, texelFetch(iChannel2, ivec2(p), 0).x, 0.0, 1.0); }

void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(iChannel0, ivec2(p), 0).xy / 24.0, 0.3, 1.0); }

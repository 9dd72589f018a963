void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel1, ivec2(p), 0) + texelFetch(iChannel2, ivec2(p), 0) * 0.5; }

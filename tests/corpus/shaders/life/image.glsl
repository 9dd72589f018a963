void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0).rrra * vec4(0.4, 0.9, 0.5, 1.0); }

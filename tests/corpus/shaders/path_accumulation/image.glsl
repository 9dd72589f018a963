void mainImage(out vec4 fragColor, in vec2 fragCoord) { vec4 s = texelFetch(iChannel0, ivec2(fragCoord), 0); fragColor = vec4(s.rgb / s.a, 1.0) * vec4(1.0, 1.0, s.a / 32.0, 1.0); }

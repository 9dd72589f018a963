void mainImage(out vec4 c, in vec2 p) { c = vec4(iResolution.xy / 256.0, iChannelResolution[0].x + iResolution.z * 0.25, 1.0); }

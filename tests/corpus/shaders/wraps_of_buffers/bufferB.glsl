void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / iResolution.xy * 3.0 - 1.25); }

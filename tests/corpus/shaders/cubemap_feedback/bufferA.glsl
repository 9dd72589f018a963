void mainImage(out vec4 c, in vec2 p) { c = textureLod(iChannel0, vec3(p / iResolution.xy - 0.5, 0.5), 0.0); }

void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, float(int(p.x) / 4 + int(p.y) / 4 & 1), 1.0); }

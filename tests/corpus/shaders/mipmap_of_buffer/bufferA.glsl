void mainImage(out vec4 c, in vec2 p) { c = vec4(step(8.0, mod(p, 16.0)), p.x / 128.0, 1.0); }

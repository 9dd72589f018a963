// A buffer keeps alpha, values below 0 and above 1, and starts at 0.
void mainImage(out vec4 c, in vec2 p) { if (p.x < 64.0) c = vec4(-4.0, 1000.0, p.y, p.x * p.y); else c.rg = vec2(0.4, 0.6); }

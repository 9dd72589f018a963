#undef SHADE
#define SHADE(x) (1.0 - (x))
#define LOCAL 1
float own(float x) { return SHADE(x); }
void mainImage(out vec4 c, in vec2 p) { c = vec4(own(p.x / iResolution.x) * stripe(p.y)); }

// Versions of a picture, one of which is chosen by a number.
#define VERSION 2
#if VERSION == 1
void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0, 0.0, 0.0, 1.0); }
#elif VERSION == 2
void mainImage(out vec4 o, in vec2 p) {
    vec2 c = floor(p / 12.0);
    o = vec4(mod(c.x + c.y, 2.0) * 0.7, 0.3, c.y / 6.0, 1.0);
}
#elif VERSION / 0
void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }
#else
void mainImage(out vec4 o, in vec2 p) { undefined things }
#endif

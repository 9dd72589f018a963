// Each tab has a helper, a macro and a global of the same names as the other's.
#define SIZE 8.0
float seed = 0.3;
vec3 paint(vec2 p) { return vec3(fract(p / SIZE), seed); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(paint(fragCoord), 1.0); }

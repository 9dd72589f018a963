#define SIZE 2
const int seed = 3;
vec3 paint(ivec2 p) { return texelFetch(iChannel0, p / SIZE, 0).rgb * float(seed) * 0.3; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(paint(ivec2(fragCoord)), 1.0); }

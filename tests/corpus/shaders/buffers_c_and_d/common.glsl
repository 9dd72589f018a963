#define PLACE ivec2(fragCoord)
const vec3 kInk = vec3(0.9, 0.5, 0.2);

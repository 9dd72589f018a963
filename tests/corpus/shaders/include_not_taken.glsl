// Made on somebody's own machine: there the helpers are a file, here they are written out.
#ifdef AT_HOME
#include "helpers/that_are_not_here.glsl"
#else
float circle(vec2 p, float r) { return length(p) - r; }
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    fragColor = vec4(smoothstep(0.0, 0.2, abs(circle(p, 0.6))), 0.4, 0.2, 1.0);
}

// What stands in branches that are not compiled is nobody's business.
#define IN_SHADERTOY
#define LEVEL 2

#ifdef NOPE
#include "nowhere.glsl"
#endif

#ifndef IN_SHADERTOY
#include <elsewhere.glsl>
uniform float undescribed; //@ and wrongly annotated
#endif

#ifndef HW_PERFORMANCE
uniform vec4 iResolution;
uniform int iTime, iMouse;
#elif LEVEL * 2 > 3 && (defined(IN_SHADERTOY) || defined NOPE)
const float kBlue = 0.75;
#else
#include "never.glsl"
#endif

#if 0
uniform vec2 iTime;
#if 1
#define kBlue 0.0
#endif
#endif

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, kBlue, 1.0);
}

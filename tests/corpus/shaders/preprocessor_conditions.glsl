// Nested #if, #elif, defined with and without brackets, #undef, sums in conditions.
#define QUALITY 2
#define FAST
#if QUALITY >= 2 && defined(FAST)
  #if QUALITY * 2 + 1 == 5
    #define RED 0.9
  #else
    #error not here
  #endif
#elif defined SLOW
  #define RED 0.1
#endif
#undef FAST
#ifdef FAST
  #define GREEN 1.0
#elif !defined(FAST) && (QUALITY & 1) == 0
  #define GREEN (RED * 0.5)
#endif
#if 0
this is no text at all ' "
#endif
#ifndef HW_PERFORMANCE
  #error the host names its speed
#endif
#if HW_PERFORMANCE == 1
  #define BLUE 0.7
#else
  #define BLUE 0.2
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(RED, GREEN, BLUE, 1.0) * fragCoord.x / iResolution.x;
}

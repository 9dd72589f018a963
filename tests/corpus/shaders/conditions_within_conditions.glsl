// Switches within switches, with words behind #else and #endif as older texts have them.
#define HIGH
//#define LOW
#ifdef HIGH
  #ifdef LOW
    #define STEPS 3
  #else
    # define STEPS 12
    #ifndef SOFT
      #define SOFT 0.3
    #endif
  #endif
#else
  #define STEPS 1
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
#if STEPS > 10
    uv = floor(uv * float(STEPS)) / float(STEPS);
#endif
    fragColor = vec4(uv, SOFT, 1.0);
}

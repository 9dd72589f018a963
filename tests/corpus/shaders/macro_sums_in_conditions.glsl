// Sums, shifts and brackets of a condition, with numbers of every spelling.
#define N 12
#define HEX 0x1F
#if (N << 2) == 060 && (HEX & 3) == 3 && -N / 5 == -2 && (N % 5 ^ 3) == 1 && !(~0 > 0)
#define RED 0.8
#else
#define RED 0.1
#endif
#if defined RED && defined(N) && !defined(NOTHING) || 1 / 1 == 2
#define GREEN 0.6
#endif
#if !defined N
#error N is missing
#elif N >= 12 && \
      N <= 12
#define BLUE 0.4
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = fragCoord.x / iResolution.x;
    fragColor = vec4(RED * x, GREEN * (1.0 - x), BLUE, 1.0);
}

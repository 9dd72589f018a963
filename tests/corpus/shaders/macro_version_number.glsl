// What the language calls itself.
#if __VERSION__ >= 300
#define TEX texture
#else
#define TEX texture2D
#endif
#ifdef GL_ES
#define BLUE 0.6
#else
#define BLUE 0.0
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(TEX(iChannel0, fragCoord).r + 0.3, float(__VERSION__) / 600.0, BLUE, 1.0);
}

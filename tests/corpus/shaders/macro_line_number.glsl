// Lines as numbers: how many lines lie between two places, here six.
const int kFirst = __LINE__;
int here(int line) { return line - kFirst; }
#define HERE here(__LINE__)
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int n = int(fragCoord.x / iResolution.x * 12.0);
    int lines = __LINE__ - kFirst;
    int spread = HERE +
                 HERE;
    fragColor = vec4(n < lines ? 0.8 : 0.1, n == spread - 7 ? 0.9 : 0.2, __FILE__ == 0 ? 0.5 : 0.7, 1.0);
}

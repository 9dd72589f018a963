// What the preprocessor knows: the version, GL_ES; lines go on behind a backslash, in comments \
too: this line is still a comment
#if __VERSION__ != 300
#error the site's shaders are GLSL ES 3.00
#endif
#ifdef GL_ES
#define ES 0.8
#endif
int add\
ed(int a) { return a + 1; }
const int here = __LINE__;

const int lines = __LINE__ - here;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(ES, float(added(4)) / 10.0, float(lines) / 4.0, 1.0) * fragCoord.y / iResolution.y;
}

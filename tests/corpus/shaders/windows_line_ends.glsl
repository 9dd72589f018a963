// Every line ends as on Windows.
#define WIDE(x) \
    ((x) * 0.5)
void mainImage(out vec4 c, in vec2 p)
{
    c = vec4(p / iResolution.xy, WIDE(0.8), 1.0); // a comment
    /* one
    more */ c.r *= 0.5;
}

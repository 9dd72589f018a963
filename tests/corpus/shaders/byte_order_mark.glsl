// A byte order mark stands before the first word, and the last line has no end.
#define K 0.75
void mainImage(out vec4 c, in vec2 p) { c = vec4(K, p / iResolution.xy, 1.0); }
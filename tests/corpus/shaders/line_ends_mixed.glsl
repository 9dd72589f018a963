// Line ends of three systems in one text.
void mainImage(out vec4 o, in vec2 p) {    // a comment ends here    vec2 uv = p / iResolution.xy;
#define BLUE 0.5
#ifdef BLUE    o = vec4(uv.yx, BLUE, 1.0);
#else    o = nothing;
#endif
}
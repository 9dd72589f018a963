#ifdef LOCAL
#error the macro of another tab
#endif
float own(float x) { return SHADE(x) * 0.5; }
void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(iChannel0, ivec2(p), 0).r, own(p.y / iResolution.y), stripe(p.x), 1.0); }

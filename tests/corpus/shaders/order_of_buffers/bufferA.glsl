// Each buffer reads an earlier one (of this frame) and a later one (of the frame before).
void mainImage(out vec4 c, in vec2 p) { c = vec4(float(iFrame), texelFetch(iChannel3, ivec2(p), 0).x, 0.0, 1.0); }

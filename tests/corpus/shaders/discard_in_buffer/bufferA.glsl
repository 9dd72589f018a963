// What is discarded keeps what that texture held: the frame before the last, as there are two.
void mainImage(out vec4 c, in vec2 p) {
    float was = texelFetch(iChannel0, ivec2(p), 0).x;
    if (iFrame > 6 && p.x > 64.0) discard;
    c = vec4(float(iFrame), was, 0.0, 1.0);
}

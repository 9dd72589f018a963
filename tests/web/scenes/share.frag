// A buffer of the picture's size and two outputs, that keeps nothing: the picture may change its size at any time.
uniform sampler2D across;  //@ pass mainAcross filter=nearest
uniform sampler2D up;      //@ pass mainAcross filter=nearest

void mainAcross(out vec4 a, out vec4 b, in vec2 coord) {
    a = vec4(coord.x / iResolution.x);
    b = vec4(coord.y / iResolution.y);
}

void mainImage(out vec4 color, in vec2 coord) {
    color = vec4(texelFetch(across, ivec2(coord), 0).r, texelFetch(up, ivec2(coord), 0).r, 0.0, 1.0);
}

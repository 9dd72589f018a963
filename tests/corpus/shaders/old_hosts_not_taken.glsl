// A head that many texts have from elsewhere.
#if defined(GL_ES) && !defined(HW_PERFORMANCE)
precision mediump float;
#extension GL_OES_standard_derivatives : enable
varying vec2 surfacePosition;
#endif
#if 0
this is no GLSL at all: it's "text", with an apostrophe and ` and \ and @
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, fwidth(uv.x) * 32.0, 1.0);
}

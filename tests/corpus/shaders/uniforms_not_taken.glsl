// One text for the site and for another host, which must declare what the site has.
#ifndef HW_PERFORMANCE
uniform vec4 iResolution;
uniform float iTime, zoom;
uniform sampler2D iChannel0, picture;
#else
const float zoom = 3.0;
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = zoom * fragCoord / iResolution.y;
    fragColor = vec4(fract(p), 0.5 + 0.5 * sin(iTime * 4.0), 1.0);
}

// The colour itself counts the turns, and is what comes out.
void mainImage(out vec4 o, vec2 u) {
    vec2 p = (u+u-iResolution.xy)/iResolution.y;
    for (o-=o; o.a++<6.; o.rgb += step(length(p = abs(p)*1.2-.4), .5)*vec3(.12,.08,.16));
}

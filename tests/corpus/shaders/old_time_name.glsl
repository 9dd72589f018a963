// iGlobalTime, as texts of 2015 have it.
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(iGlobalTime, fragCoord / iResolution.xy, 1.0); }

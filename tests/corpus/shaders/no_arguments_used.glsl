// gl_FragCoord is there as well; alpha is whatever it likes.
void mainImage(out vec4 o, vec2 u) { o = vec4(gl_FragCoord.xy / iResolution.xy, gl_FragCoord.z + 0.1, 0.0); }

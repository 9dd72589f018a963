void mainImage(out vec4 o, vec2) { o = vec4(gl_FragCoord.xy / iResolution.xy, .5, 1); }

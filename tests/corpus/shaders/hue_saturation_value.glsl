vec3 rgb(vec3 c) { vec3 k = abs(fract(c.xxx + vec3(0, 2, 1) / 3.0) * 6.0 - 3.0); return c.z * mix(vec3(1.0), clamp(k - 1.0, 0.0, 1.0), c.y); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) { vec2 uv = fragCoord / iResolution.xy; fragColor = vec4(rgb(vec3(uv.x, uv.y, 0.9)), 1.0); }

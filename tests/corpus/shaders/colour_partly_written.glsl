// One component is written, alpha never.
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor.rgb = vec3(0.0); fragColor.g = fragCoord.x / iResolution.x; }

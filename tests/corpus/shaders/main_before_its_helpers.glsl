// mainImage stands first and its helpers behind; a prototype without names is enough.
vec3 helper(vec2, float);
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor.rgb = helper(fragCoord / iResolution.xy, 0.7); }
vec3 helper(vec2 uv, float k) { return vec3(uv * k, 1.0 - uv.x); }

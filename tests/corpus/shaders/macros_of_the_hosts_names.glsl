// The text may call anything anything: the host's main stands before it.
#define color vec3(0.2, 0.4, 0.6)
#define coord 0.5
#define main mainImage
#define vec4_ vec4
#define out_ out
#define iTime (iTime * 2.0)
void main(out_ vec4_ c, in vec2 p) { c = vec4(color * coord + iTime * p.x / 256.0, 1.0); }

// A loop whose head does it all, with two counters and no body.
void mainImage(out vec4 o,vec2 u){for(ivec2 a=ivec2(u),b=ivec2(o*=0.);b.x<7&&b.y<9;b.x++,b.y+=a.x>>b.x&1)o.xy+=vec2(a.y>>b.x&1,b.y)*.07;o.b=.3;}

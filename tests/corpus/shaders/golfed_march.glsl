// A whole march in one for.
#define r(a) mat2(cos(a+vec4(0,33,11,0)))
void mainImage(out vec4 o,vec2 u){float i,d,t;vec3 p,R=iResolution;
for(o*=i;i++<40.;t+=d=max(abs(p.x),max(abs(p.y),abs(p.z)))-.7)
p=vec3((u+u-R.xy)/R.y*t,t-3.),p.xz*=r(.6),p.yz*=r(.4);
o+=t<6.?vec4(step(abs(p),vec3(.69))*.4+.3,1):vec4(.1,.1,.2,1);}

// A whole march in a for statement; the colour and the counters start at 0 by themselves.
void mainImage(out vec4 o,vec2 u){vec2 r=iResolution.xy;float i,t,d;for(;i++<48.;t+=d*.7){vec3 p=t*normalize(vec3(u+u-r,r.y));p.z+=iTime-4.;p.xy+=.4;d=length(mod(p,2.)-1.)-.5;o+=max(0.,.06-d)*vec4(3,5,8,0);}}

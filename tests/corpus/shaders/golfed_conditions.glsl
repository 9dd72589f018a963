// Conditions by commas, steps and nested question marks.
void mainImage(out vec4 o, vec2 u) {
    vec2 p = u/iResolution.y; int n = int(p.x*8.), m = int(p.y*8.);
    o = n%3<1 ? m%2<1 ? vec4(.9,.2,.1,1) : vec4(.1) : (n+=m, n%2<1) ? vec4(0,.5,.6,1) : vec4(step(.5,fract(p*4.)),.3,1);
}

#define R(a) mat2(cos(a+vec4(0,11,33,0)))
#define V vec2
#define S(a,b) smoothstep(a+.05,a-.05,length(b))
#define L(n) for(int i=0;i<n;i++)
void mainImage(out vec4 o, V u) {
    V p = (u+u-iResolution.xy)/iResolution.y, q;
    o = vec4(.1,.1,.2,1);
    L(5) q = p*R(float(i)*1.2566+iTime), o.rgb = mix(o.rgb, vec3(i&1,i>>1&1,1), S(.2,q-V(.6,0)));
}

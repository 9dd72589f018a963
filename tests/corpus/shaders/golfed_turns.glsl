// A spiral in few letters.
void mainImage(out vec4 O, vec2 U) {
    vec2 R = iResolution.xy; U = (U+U-R)/R.y; O *= 0.; float l = length(U), i = 0.;
    for (U *= mat2(cos(l*4.+vec4(0,33,11,0))); i++ < 3.; O[int(i)-1] = .5+.5*cos(atan(U.y,U.x)*i));
}

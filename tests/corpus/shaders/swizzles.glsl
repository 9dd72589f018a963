// Swizzles of all three sets, as targets, of swizzles, of calls and of numbers made vectors.
vec4 both(vec2 p) { return p.xyyx; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 v = vec4(0.0);
    v.zx = fragCoord / iResolution.xy;
    v.tq = v.rb * 0.5;
    v.ga += vec2(0.1);
    v.wzyx.xy *= 0.8;
    fragColor = both(v.xz).stpq.bgra * vec4(v.www, 1.0) + v.yyyy * 0.5;
    fragColor[1] = v[2];
}

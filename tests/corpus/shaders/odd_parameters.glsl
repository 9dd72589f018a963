// The signature as people write it: names, qualifiers and lines as they like.
const float k = 0.5;
void
mainImage
(
    out highp vec4 _,
    in mediump
        vec2 p0_
)
{ _ = vec4(p0_.xy / iResolution.xy, k, 1); }

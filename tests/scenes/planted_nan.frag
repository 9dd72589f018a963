// A planted NaN: the square root of what is negative where the tweak is high and the picture is low.
uniform float height;         //@ 0.2 [0, 2] "of the wall"
void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    float depth = sqrt(uv.y + 1.0 - height);
    colour = vec4(vec3(depth) * 0.5, 1.0);
}

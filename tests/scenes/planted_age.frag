// A planted failure of age: a fast wave on a float clock, which has lost its digits after a day.
void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    colour = vec4(vec3(0.5 + 0.5 * sin(20.0 * uv.x + sin(100.0 * iTime))), 1.0);
}

// One name, five things: a function, a parameter, a block's, a loop's, a member.
float x(float x) { { float x = x * 0.5; if (x > 0.2) { float x = 0.8; return x; } } return x; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float a = x(fragCoord.x / iResolution.x);
    for (int x = 0; x < 3; ++x) a += float(x) * 0.04;
    struct X { vec2 x; };
    X y = X(fragCoord / iResolution.xy);
    fragColor = vec4(a, y.x, 1.0);
}

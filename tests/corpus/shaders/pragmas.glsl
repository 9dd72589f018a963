// Pragmas that browsers pass over, whatever stands behind them.
#pragma optimize(off);
#pragma debug(on) and more
#pragma something(unheard, of) { "
#pragma

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, 0.25, 1.0);
}

// Words of precision before parameters, members, constants, results and in an inner block.
precision highp float;
struct Low { lowp vec3 c; highp float x; };
const mediump float kBig = 1000.0;
mediump float ramp(const in highp float x, lowp float y) { return fract(x / kBig) + y; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Low low = Low(vec3(0.2, 0.4, 0.6), fragCoord.x * 3001.0);
    {
        precision mediump int;
        mediump int n = int(fragCoord.y) / 9;
        low.c.g = float(n) / 8.0;
    }
    fragColor = vec4(low.c + ramp(low.x, 0.1) * 0.5, 1.0);
}

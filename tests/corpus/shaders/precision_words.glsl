// Words of precision change nothing on a machine that has one precision.
precision mediump float;
precision highp int;
lowp vec3 tint(mediump vec2 uv) { highp float x = uv.x * 4096.0; return vec3(fract(x * 0.03125), uv.y, 0.25); }
void mainImage(out mediump vec4 fragColor, in highp vec2 fragCoord) {
    lowp vec2 uv = fragCoord / iResolution.xy;
    mediump int n = int(fragCoord.x) * 1000;
    fragColor = vec4(tint(uv) + float(n % 1024) / 2048.0, 1.0);
}

// exp, log, pow, roots and what is made of them are as near on SwiftShader as on Mesa, but not the same to the last bit: at an edge, or
// where a march just meets something, that moves a pixel. Before a page's own script this gives its shaders those functions
// made of sums, products, quotients and square roots alone, which all drivers round alike; off by some 1e-6.
{
    const KINDS = ["float", "vec2", "vec3", "vec4"];
    // The same for vectors, component by component; `rest` are the other arguments.
    const wide = (name, count) => KINDS.slice(1).map((kind, i) => {
        const names = ["x", "y", "z"].slice(0, count);
        const parts = [..."xyzw"].slice(0, i + 2).map(c => `own_${name}(${names.map(v => `${v}.${c}`)})`);
        return `${kind} own_${name}(${names.map(v => `${kind} ${v}`)}) { return ${kind}(${parts}); }`;
    });
    const FUNCTIONS = `
float own_exp2(float x) {
    if (x < -126.0) return 0.0;
    if (x >= 128.0) return intBitsToFloat(0x7f800000);
    float k = floor(x), f = (x - k) * 0.69314718;
    float e = 1.0 + f * (1.0 + f * (0.5 + f * (0.16666667 + f * (0.041666667 + f * (8.3333333e-3 + f * (1.3888889e-3 + f * 1.984127e-4))))));
    return e * intBitsToFloat((int(k) + 127) << 23);
}
float own_log2(float x) {
    if (!(x > 0.0) || x > 3.4e38) return x == 0.0 ? -intBitsToFloat(0x7f800000) : x > 0.0 ? x : intBitsToFloat(0x7fc00000);
    int bits = floatBitsToInt(x), e = (bits >> 23) - 127;
    float m = intBitsToFloat((bits & 0x7fffff) | 0x3f800000);
    if (m > 1.4142135) { m *= 0.5; ++e; }
    float t = (m - 1.0) / (m + 1.0), s = t * t;
    return float(e) + 2.8853901 * t * (1.0 + s * (0.33333333 + s * (0.2 + s * (0.14285714 + s * 0.11111111))));
}
float own_exp(float x) { return own_exp2(x * 1.4426950); }
float own_log(float x) { return own_log2(x) * 0.69314718; }
float own_pow(float x, float y) { return own_exp2(y * own_log2(x)); }
float own_inversesqrt(float x) { return 1.0 / sqrt(x); }
float own_dot(float x, float y) { return x * y; }
float own_dot(vec2 x, vec2 y) { return x.x * y.x + x.y * y.y; }
float own_dot(vec3 x, vec3 y) { return x.x * y.x + x.y * y.y + x.z * y.z; }
float own_dot(vec4 x, vec4 y) { return x.x * y.x + x.y * y.y + x.z * y.z + x.w * y.w; }
float own_mix(float x, float y, float z) { return x + (y - x) * z; }
float own_mix(float x, float y, bool z) { return z ? y : x; }
float own_smoothstep(float x, float y, float z) { float t = clamp((z - x) / (y - x), 0.0, 1.0); return t * t * (3.0 - 2.0 * t); }
` + [...["exp2", "log2", "exp", "log", "inversesqrt"].flatMap(name => wide(name, 1)), ...wide("pow", 2), ...wide("mix", 3), ...wide("smoothstep", 3),
        ...KINDS.slice(1).flatMap(kind => [
            `${kind} own_mix(${kind} x, ${kind} y, float z) { return x + (y - x) * z; }`,
            `${kind} own_mix(${kind} x, ${kind} y, b${kind} z) { return mix(x, y, z); }`,
            `${kind} own_smoothstep(float x, float y, ${kind} z) { return own_smoothstep(${kind}(x), ${kind}(y), z); }`]),
        ...KINDS.flatMap(kind => [
            `float own_length(${kind} x) { return sqrt(own_dot(x, x)); }`,
            `float own_distance(${kind} x, ${kind} y) { return own_length(x - y); }`,
            `${kind} own_normalize(${kind} x) { return x * (1.0 / sqrt(own_dot(x, x))); }`,
            `${kind} own_reflect(${kind} x, ${kind} y) { return x - 2.0 * own_dot(y, x) * y; }`]),
        ...["exp2", "log2", "exp", "log", "pow", "inversesqrt", "dot", "mix", "smoothstep", "length", "distance", "normalize", "reflect"]
            .map(name => `#define ${name} own_${name}`)].join("\n") + "\n";
    const set = WebGL2RenderingContext.prototype.shaderSource;
    WebGL2RenderingContext.prototype.shaderSource = function (shader, text) {
        const begin = "precision highp sampler3D;\n";  // behind which the text may have functions
        set.call(this, shader, text.replace(begin, begin + FUNCTIONS));
    };
}

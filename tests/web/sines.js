// SwiftShader's sin and cos are off by up to 2e-4 (Vulkan asks for 2^-11); Mesa's by 7e-8. Before a page's own script this
// gives its shaders sines that are worked out the same way by every driver, off by 2e-7 at most up to some 10^5.
{
    const SINES = `
float own_turn(float x) { float k = floor(x * 0.15915494 + 0.5); return x - k * 6.28125 - k * 0.0019353072; }
float own_arc(float x) {
    float s = x * x;
    return x * (1.0 + s * (-0.16666667 + s * (8.3333333e-3 + s * (-1.9841270e-4 + s * (2.7557319e-6 - s * 2.5052108e-8)))));
}
float own_sin(float x) { x = own_turn(x); return own_arc(x > 1.5707963 ? 3.1415927 - x : x < -1.5707963 ? -3.1415927 - x : x); }
float own_cos(float x) { return own_arc(1.5707963 - abs(own_turn(x))); }
` + ["sin", "cos"].flatMap(name => [2, 3, 4].map(n =>
        `vec${n} own_${name}(vec${n} x) { return vec${n}(${[..."xyzw"].slice(0, n).map(c => `own_${name}(x.${c})`)}); }`)).join("\n") + `
#define sin own_sin
#define cos own_cos
`;
    const set = WebGL2RenderingContext.prototype.shaderSource;
    WebGL2RenderingContext.prototype.shaderSource = function (shader, text) {
        const begin = "precision highp sampler3D;\n";  // behind which the text may have functions
        set.call(this, shader, text.replace(begin, begin + SINES));
    };
}

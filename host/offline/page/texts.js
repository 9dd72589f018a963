// The GLSL of a pass. Tweaks are written in as constants, or are uniforms while one is moved.

// The exponent makes a float of any number, and -0 has a sign of its own.
const literal = (type, v) =>
    type === "int" ? v : (1 / v === -Infinity ? "-" : "") + Math.fround(v).toExponential(8);

// What an index may be made of is a variable: a constant out of range does not compile.
export const declaration = ({name, type, index}, value) => value
    ? `${index ? "" : "const "}${type} ${name} = ${type}(${value.map(v => literal(type, v))});`
    : `uniform ${type} ${name};`;

// By whether a value is 0 the host's text divides by it, or multiplies with what is beyond all floats.
export const definitions = (tweak, i, value) => [
    `#define glint_tweak${i} ${declaration(tweak, value)}`,
    `#define glint_zero${i} ${value && !Math.fround(value[0]) ? 1 : 0}`,
];

// `values`: of all tweaks, or null. Drivers that draw in software have a text of their own, where the host has one for them.
// `added` counts the lines before the scene's own.
export const textOf = (plan, pass, values, isSoftware) => {
    const lines = (isSoftware && pass.soft || pass.text).flatMap(run => plan.lines.slice(...run));
    const names = plan.tweaks.flatMap((tweak, i) => definitions(tweak, i, values?.[i]));
    lines.splice(1, 0, ...names);  // behind #version
    return {text: lines.join("\n"), added: pass.first + names.length};
};

// The GLSL of a pass. Tweaks are written in as constants, or are uniforms while one is moved.

// The exponent makes a float of any number.
const literal = (type, v) => type === "int" ? v : Math.fround(v).toExponential(8);

// A value of 0 by which something is divided stays a uniform: drivers make garbage of constants there.
export const declaration = ({name, type, divides}, value) => {
    if (!value || divides && value.includes(0)) return `uniform ${type} ${name};`;
    return `const ${type} ${name} = ${type}(${value.map(v => literal(type, v))});`;
};

// `values`: of all tweaks, or null. Drivers that draw in software have a text of their own, where the host has one for them.
// `added` counts the lines before the scene's own.
export const textOf = (plan, pass, values, isSoftware) => {
    const lines = (isSoftware && pass.soft || pass.text).flatMap(run => plan.lines.slice(...run));
    const names = plan.tweaks.map((tweak, i) => `#define glint_tweak${i} ${declaration(tweak, values?.[i])}`);
    lines.splice(1, 0, ...names);  // behind #version
    return {text: lines.join("\n"), added: pass.first + names.length};
};

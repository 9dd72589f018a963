// The GLSL of a pass. Tweaks are written in as constants, or are uniforms while one is moved.

const literal = (type, v) => {
    if (type === "int") return `${v}`;
    if (type === "bool") return `${!!v}`;
    const text = `${+Math.fround(v).toPrecision(9)}`;
    return /[.e]/.test(text) ? text : text + ".0";
};

export function declaration({name, type, value: initial}, value) {
    if (!value) return `uniform ${type} ${name};`;
    const words = value.map(v => literal(type, v)).join(", ");
    return `const ${type} ${name} = ${initial.length > 1 ? `${type}(${words})` : words};`;
}

// `values`: of all tweaks, or null. `added` counts the lines before the scene's own.
export function textOf(plan, pass, values) {
    const lines = [];
    for (let i = 0; i < pass.text.length; i += 2)
        for (let k = 0; k < pass.text[i + 1]; ++k) lines.push(plan.lines[pass.text[i] + k]);
    const names = plan.tweaks.map((tweak, i) => `#define glint_tweak${i} ${declaration(tweak, values?.[i])}`);
    return {text: [lines[0], ...names, ...lines.slice(1), ""].join("\n"), added: pass.first + names.length};
}

// The look in the address: #t=12&choppiness=0.3&waterTint=%230b3a53 names what differs from the preset.

const hex = v => Math.round(v * 255).toString(16).padStart(2, "0");

// A value as presets write it.
export function format(tweak, value) {
    if (tweak.type === "bool") return value[0] ? "on" : "off";
    if (tweak.names) return tweak.names[value[0]];
    if (tweak.colour && value.every(v => v >= 0 && v <= 1 && Math.abs(Math.round(v * 255) - v * 255) < 1e-9))
        return "#" + value.map(hex).join("");
    return value.map(v => +v.toPrecision(7)).join(",");
}

export function clamp(tweak, value) {
    const whole = tweak.type === "int" || tweak.type === "bool";
    const [min, max] = tweak.names ? [0, tweak.names.length - 1] : tweak.type === "bool" ? [0, 1] : tweak.range ?? [-3e38, 3e38];
    return value.map(v => Math.min(Math.max(whole ? Math.round(v) : v, min), max));
}

// The inverse; nothing where the text is no value of the tweak.
export function parse(tweak, text) {
    const count = tweak.value.length;
    let value = text.split(",").map(part => part.trim() ? +part : NaN);
    if (tweak.type === "bool") value = [{on: 1, off: 0, true: 1, false: 0}[text] ?? value[0]];
    if (tweak.names?.includes(text)) value = [tweak.names.indexOf(text)];
    if (/^#([0-9a-f]{2}){3,4}$/i.test(text)) {
        value = text.match(/[0-9a-f]{2}/gi).map(byte => parseInt(byte, 16) / 255);
        if (value.length < count) value.push(1);
    }
    return value.length === count && value.every(Number.isFinite) ? clamp(tweak, value) : undefined;
}

// {time, paused, values} of a hash; names that the scene does not have are left alone.
export function readLook(plan, hash) {
    const words = new URLSearchParams(hash.replace(/^#/, "")), t = parseFloat(words.get("t"));
    return {
        time: t >= 0 && t <= 1e9 ? t : plan.time,
        paused: words.has("paused"),
        values: plan.tweaks.map(tweak => words.has(tweak.name) && parse(tweak, words.get(tweak.name)) || tweak.value),
    };
}

export function writeLook(plan, {time, paused, values}) {
    const words = paused ? [`t=${+time.toFixed(3)}`, "paused"] : [];
    plan.tweaks.forEach((tweak, i) => {
        const text = format(tweak, values[i]);
        if (text !== format(tweak, tweak.value)) words.push(`${tweak.name}=${encodeURIComponent(text)}`);
    });
    return words.join("&");
}

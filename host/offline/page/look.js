// The look in the address: #t=12&choppiness=0.3&waterTint=%230b3a53 names what differs from the preset.
import {clamp, round} from "./arithmetic.js";

export const hexOf = value => "#" + value.map(v => round(clamp(v, 0, 1) * 255).toString(16).padStart(2, "0")).join("");

// A value as presets write it. The host gives names to what is on or off, and to what has names a range.
export function format({names, colour}, value) {
    if (names) return names[value[0]];
    if (colour && value.every(v => v >= 0 && v <= 1 && Math.abs(round(v * 255) - v * 255) < 1e-9)) return hexOf(value);
    return `${value.map(v => +v.toPrecision(7))}`;
}

export const fitted = ({type, names, range: [min, max] = [-3e38, 3e38]}, value) =>
    value.map(v => clamp(names || type === "int" ? round(v) : v, min, max));

// The inverse; nothing where the text is no value of the tweak.
export function parse(tweak, text) {
    const {names, value: {length}} = tweak;
    let value = text.split(",").map(part => part.trim() ? +part : NaN);
    if (names?.includes(text)) value = [names.indexOf(text)];
    if (/^#([0-9a-f]{2}){3,4}$/i.test(text)) value = [...text.match(/[0-9a-f]{2}/gi).map(byte => parseInt(byte, 16) / 255), 1].slice(0, length);
    return value.length === length && value.every(Number.isFinite) ? fitted(tweak, value) : undefined;
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

// The look in the address: #t=12&choppiness=0.3&waterTint=%230b3a53 names what differs from the preset.
import {clamp, round} from "./arithmetic.js";

const byteOf = v => round(clamp(v, 0, 1) * 255);
export const hexOf = value => "#" + value.map(v => byteOf(v).toString(16).padStart(2, 0)).join("");

// A value as presets write it. The host gives names to what is on or off, and to what has names a range.
export const format = ({names, colour}, value) => {
    if (names) return names[value[0]];
    if (colour && value.every(v => Math.abs(byteOf(v) / 255 - v) < 1e-9)) return hexOf(value);
    return `${value.map(v => +v.toPrecision(7))}`;
};

export const fitted = ({type, names, range: [min, max] = [-3e38, 3e38]}, value) =>
    value.map(v => clamp(names || type === "int" ? round(v) : v, min, max));

// The inverse; nothing where the text is no value of the tweak.
export const parse = (tweak, text) => {
    const {names, value: {length}} = tweak, [, ...bytes] = text.match(/^#(..)(..)(..)(..)?$/) ?? [];
    const value = names?.includes(text) ? [names.indexOf(text)]
        : bytes[0] ? bytes.slice(0, length).map(byte => `0x${byte ?? "ff"}` / 255)
        : text.split(",").map(part => part.trim() ? +part : NaN);
    return value.length === length && value.every(Number.isFinite) ? fitted(tweak, value) : undefined;
};

// {time, paused, values} of a hash; names that the scene does not have are left alone.
// Two tweaks may have the names of what else stands there.
const wordOf = ({name}) => name.replace(/^(t|paused)$/, "$&.");

export const readLook = (plan, hash) => {
    const words = new URLSearchParams(hash.slice(1)), t = parseFloat(words.get("t"));
    return {
        time: t >= 0 && t <= 1e9 ? t : plan.time,
        paused: words.has("paused"),
        values: plan.tweaks.map(tweak => parse(tweak, words.get(wordOf(tweak)) ?? "") ?? tweak.value),
    };
};

export const writeLook = (plan, {time, paused, values}) => {
    const words = paused ? [`t=${+time.toFixed(3)}`, "paused"] : [];
    plan.tweaks.forEach((tweak, i) => {
        const text = format(tweak, values[i]);
        if (text !== format(tweak, tweak.value)) words.push(`${wordOf(tweak)}=${encodeURIComponent(text)}`);
    });
    return words.join("&");
};

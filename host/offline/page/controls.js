// The browser's own controls, as the host wrote them, move the tweaks and show them.
import {log as ln, round} from "./arithmetic.js";
import {fitted, format, hexOf, parse} from "./look.js";

export const on = (target, events, act) => events.split(" ").forEach(event => target.addEventListener(event, act));

// Where a slider stands, from 0 to 1, and back.
export const fractionOf = ({range: [min, max], log}, v) => log ? ln(v / min) / ln(max / min) : (v - min) / (max - min);
export function valueAt(tweak, fraction) {
    const {range: [min, max], log, step} = tweak, v = log ? min * (max / min) ** fraction : min + (max - min) * fraction;
    return fitted(tweak, [step ? min + round((v - min) / step) * step : +v.toPrecision(4)])[0];
}

// By the kind of a control: the value at which it stands, and how it comes to stand there.
const READ = {
    checkbox: e => [+e.checked],
    "select-one": e => [e.selectedIndex],
    range: (e, tweak) => [valueAt(tweak, +e.value)],
    color: (e, tweak, last) => [...parse({value: [0, 0, 0]}, e.value), ...last.slice(3)],
    text: (e, tweak, last) => parse(tweak, e.value) ?? last,
};
const SHOW = {
    checkbox: (e, tweak, [v]) => e.checked = v,
    "select-one": (e, tweak, [v]) => e.selectedIndex = v,
    range: (e, tweak, [v]) => e.value = fractionOf(tweak, v),
    color: (e, tweak, value) => e.value = hexOf(value.slice(0, 3)),
    text: (e, tweak, value) => e.value = format(tweak, value),
};

// `rows` stand in the order of the tweaks, `set` hears of a new value. Returns what shows the values.
export function bindControls(rows, tweaks, set) {
    let values;
    const controls = i => rows[i].querySelectorAll("input,select");
    tweaks.forEach((tweak, i) => {
        for (const e of controls(i)) on(e, e.type === "text" ? "change" : "input", () => set(i, READ[e.type](e, tweak, values[i])));
        on(rows[i].querySelector("button"), "click", () => set(i, tweak.value));
    });
    return shown => {
        values = shown;
        tweaks.forEach((tweak, i) => {
            for (const e of controls(i)) SHOW[e.type](e, tweak, values[i]);
            rows[i].classList.toggle("moved", format(tweak, values[i]) !== format(tweak, tweak.value));
        });
    };
}

// The browser's own controls, as the host wrote them, move the tweaks and show them.
import {exp, log as ln} from "./arithmetic.js";
import {fitted, format, hexOf, parse} from "./look.js";

export const on = (target, events, act) => events.split(" ").forEach(event => target.addEventListener(event, act));

// Where a slider stands, and the value there: the host wrote its ends, logarithms where it goes by factors.
export const slideOf = ({log}, v) => log ? ln(v) : v;
export const valueAt = (tweak, place) => fitted(tweak, [+(tweak.log ? exp(place) : +place).toPrecision(4)]);

// By the kind of a control: the value at which it stands, and how it comes to stand there.
const KINDS = {
    checkbox: [e => [+e.checked], (e, tweak, [v]) => e.checked = v],
    "select-one": [e => [e.selectedIndex], (e, tweak, [v]) => e.selectedIndex = v],
    range: [(e, tweak) => valueAt(tweak, e.value), (e, tweak, [v]) => e.value = slideOf(tweak, v)],
    color: [(e, tweak, last) => [...parse({value: [0, 0, 0]}, e.value), ...last.slice(3)], (e, tweak, value) => e.value = hexOf(value.slice(0, 3))],
    text: [(e, tweak, last) => parse(tweak, e.value) ?? last, (e, tweak, value) => e.value = format(tweak, value)],
};

// `rows` stand in the order of the tweaks, `set` hears of a new value. Returns what shows the values.
export const bindControls = (rows, tweaks, set) => {
    let values;
    const shows = tweaks.map((tweak, i) => {
        const shown = [...rows[i].querySelectorAll("input,select")].map(e => {
            const [read, show] = KINDS[e.type];
            on(e, e.type === "text" ? "change" : "input", () => set(i, read(e, tweak, values[i])));
            return () => show(e, tweak, values[i]);
        });
        on(rows[i].querySelector("button"), "click", () => set(i, tweak.value));
        return () => {
            shown.forEach(show => show());
            rows[i].classList.toggle("moved", format(tweak, values[i]) !== format(tweak, tweak.value));
        };
    });
    return now => {
        values = now;
        shows.forEach(show => show());
    };
};

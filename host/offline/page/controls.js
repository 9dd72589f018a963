// Tweaks as the browser's own controls, by group.
import {clamp, format, parse} from "./look.js";

const make = (name, more = {}, ...children) => {
    const element = Object.assign(document.createElement(name), more);
    element.append(...children);
    return element;
};

// waterTint: "water tint".
const words = name => name.replace(/([a-z0-9])([A-Z])/g, "$1 $2").toLowerCase();

// Where a slider stands, from 0 to 1, and back.
export const fractionOf = ({range: [min, max], log}, v) => log ? Math.log(v / min) / Math.log(max / min) : (v - min) / (max - min);
export function valueAt(tweak, fraction) {
    const {range: [min, max], log, step} = tweak, v = log ? min * (max / min) ** fraction : min + (max - min) * fraction;
    return clamp(tweak, [step ? min + Math.round((v - min) / step) * step : +v.toPrecision(4)])[0];
}

// The control of one tweak: its elements, and how it shows a value. `set` hears of a new one.
function control(tweak, set) {
    const on = (element, event, value) => (element.addEventListener(event, () => { const v = value(); if (v) set(v); }), element);
    if (tweak.type === "bool") {
        const box = on(make("input", {type: "checkbox"}), "input", () => [+box.checked]);
        return [[box], ([v]) => box.checked = v];
    }
    if (tweak.names) {
        const menu = on(make("select", {}, ...tweak.names.map(name => make("option", {}, name))), "input", () => [menu.selectedIndex]);
        return [[menu], ([v]) => menu.selectedIndex = v];
    }
    const field = on(make("input", {className: "field", spellcheck: false}), "change", () => parse(tweak, field.value) ?? (show(last), null));
    let last;
    const show = value => { last = value; field.value = format(tweak, value); more?.(value); };
    let more;
    if (tweak.colour) {
        const well = on(make("input", {type: "color"}), "input", () => [...parse({...tweak, value: [0, 0, 0]}, well.value), ...last.slice(3)]);
        more = value => well.value = format({colour: true}, clamp({range: [0, 1]}, value.slice(0, 3)).map(v => Math.round(v * 255) / 255));
        return [[well, field], show];
    }
    if (tweak.value.length === 1 && tweak.range) {
        const slider = on(make("input", {type: "range", min: 0, max: 1, step: "any"}), "input", () => [valueAt(tweak, +slider.value)]);
        more = ([v]) => slider.value = fractionOf(tweak, v);
        return [[slider, field], show];
    }
    return [[field], show];
}

// Fills the panel; returns what shows the values.
export function makeControls(panel, plan, set) {
    const shows = [];
    let group, body = panel;
    plan.tweaks.forEach((tweak, i) => {
        if (tweak.group !== group) {
            group = tweak.group;
            body = make("details", {open: true}, make("summary", {}, group ?? ""));
            panel.append(body);
        }
        const [elements, show] = control(tweak, value => set(i, value));
        const reset = make("button", {className: "reset", title: "as in the preset", onclick: () => set(i, tweak.value)}, "↺");
        const name = make("span", {title: `${tweak.name}: ${tweak.what ?? ""}`}, words(tweak.name), make("i", {}, tweak.unit ?? ""));
        elements.forEach(element => element.ariaLabel = tweak.name);
        const row = make("div", {className: "row"}, name, reset, ...elements);
        body.append(row);
        shows.push(value => {
            show(value);
            row.classList.toggle("moved", format(tweak, value) !== format(tweak, tweak.value));
        });
    });
    return values => shows.forEach((show, i) => show(values[i]));
}

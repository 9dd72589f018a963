// The page: a plan, a canvas, its controls.
import {clamp, max, min, round} from "./arithmetic.js";
import {makeClock, frameAt, lastFrame, playedFrame} from "./clock.js";
import {makeTape} from "./input.js";
import {makePlayer} from "./player.js";
import {makeSound} from "./sound.js";
import {makeHolder} from "./holder.js";
import {bindControls, on} from "./controls.js";
import {readLook, writeLook} from "./look.js";

const $ = id => document.getElementById(id), canvas = $("picture");
const plan = JSON.parse($("plan").textContent), first = readLook(plan, location.hash);
const gl = canvas.getContext("webgl2", {alpha: false, antialias: false, depth: false, powerPreference: "high-performance"});
const tape = makeTape(plan.events), clock = makeClock(first.time), holder = makeHolder(), body = document.body.classList;
let player, reader, sound, values = first.values, index = 0, isReady = false, seeking = 0, wanted, hasUniforms, rest, frames = 0, since = 0;

const say = (textContent, className = "") => Object.assign($("says"), {textContent, className});
const notes = new Set();
const note = text => say([...text ? notes.add(text) : notes].join("\n"));

// --- looks

const start = async () => {
    if (!gl) throw Error("There is no WebGL 2.");
    player = makePlayer(gl, plan, plan.passes, note);
    player.values = values;
    hasUniforms = false;
    const linked = await player.link(values);
    fit();
    player.size = [canvas.width, canvas.height];
    player.use(linked);
    isReady = true;
    await seek(clock.time);
};

// The constants of this look become those of the programs, once no tweak moves any more; while one does, uniforms.
const relink = async constants => {
    const mine = wanted = {};
    hasUniforms ||= !constants;
    const linked = await player.link(constants).catch(fail);
    if (linked && mine === wanted && (constants ?? values) === values) {
        player.use(linked);
        hasUniforms = !constants;
    } else linked?.forEach(({id}) => gl.deleteProgram(id));
};

const setValues = next => {
    show(next);
    if (!gl || `${next}` === `${values}`) return;
    player.values = values = next;
    if (hasUniforms) player.root.drawn = false; else relink(null);
    clearTimeout(rest);
    rest = setTimeout(() => { keepLook(); relink(values); sound?.load(values).catch(fail); }, 700);
};

const keepLook = () => {
    const look = "#" + writeLook(plan, {time: clock.time, paused: !clock.playing, values});
    try { history.replaceState(null, "", look); } catch { /* as a text within another page it has no address */ }
};

// --- frames

// Plays to a time as `glint still` does, a few frames at a time.
const seek = async time => {
    const mine = ++seeking, last = lastFrame(time), end = last + plan.settle;
    clock.time = time;
    player.reset();
    reader = tape.reader();
    index = player.isStateful ? 0 : end;
    const input = frame => Object.assign(frame, reader.input(frame.iTime, player.size, frame.from), {tape});
    for (let count = 1; index < end;) {
        const began = performance.now();
        for (let i = 0; i < count && index < end; ++i) player.draw(input(playedFrame(plan, index++, time)), true);
        await player.wait();
        count = max(1, round(count * min(2, 60 / (performance.now() - began + 1))));
        await new Promise(requestAnimationFrame);
        if (mine !== seeking) return;
        if (end > 200) say(`${round(100 * index / end)} %`);
    }
    player.draw(input(playedFrame(plan, end, time)));
    seeking = 0;
    ++index;
    note();
    body.add("drawn");
    sounds();
};

// One more frame, `delta` seconds after the last one; 0 where time stands still.
const draw = delta => player.draw({
    ...frameAt(plan, clock.time, delta || 1 / 60, index++), ...reader.input(clock.time + 1e-6, player.size), tape, longest: 0.25});

// The frame that stands there, once more.
const again = () => {
    player.root.drawn = false;
    --index;
    draw(0);
};

let moved = false;
const tick60 = now => {
    requestAnimationFrame(tick60);
    if (!isReady || seeking || document.hidden) { clock.last = null; return; }
    const delta = clock.advance(now);
    if (clock.playing && !plan.fixed && !player.keepsSize) holder.took(delta * 1000);
    fit();  // before the frame is drawn: another size empties the canvas
    if (clock.playing || moved) { if (draw(delta)) ++frames; moved = false; }
    else if (player.live.some(pass => !pass.drawn && !pass.step)) again();  // steps wait until they are due
    if (now - since > 500) {
        $("rate").textContent = `${clock.playing ? round(frames * 1000 / (now - since)) + " Hz " : ""}${canvas.width}×${canvas.height}`;
        if (document.activeElement !== $("time")) $("time").value = clock.time.toFixed(2);
        frames = 0;
        since = now;
    }
};

// --- the picture's size

// What carries the picture's pixels on keeps its size, unless there was no room for it yet, or another one is chosen: then it
// is played anew.
const fit = isChosen => {
    const scale = plan.fixed ? 1 : canvas.clientWidth / plan.size[0] * devicePixelRatio * holder.share;
    const size = plan.size.map(s => max(1, round(s * scale)));
    if (`${size}` === `${[canvas.width, canvas.height]}` || isReady && player.keepsSize && canvas.width > 1 && !isChosen) return;
    [canvas.width, canvas.height] = size;
    if (!isReady) return;
    player.resize(size);
    if (player.keepsSize) seek(clock.time);
};

// --- buttons

const plays = on => body.toggle("paused", !(clock.playing = on));
const play = on => {
    plays(on);
    keepLook();
    sounds();
};
const sounds = () => {
    if (!sound) return;
    if (clock.playing && body.contains("loud") && !document.hidden) sound.play(clock.time); else sound.stop();
};
const go = time => {
    seek(time);
    keepLook();
};
const press = {
    play: () => play(!clock.playing),
    again: () => go(0),
    step: () => { if (!seeking) { clock.time += 1 / 60; play(false); draw(1 / 60); since = 0; } },
    save: () => {
        player.again();
        Object.assign(document.createElement("a"), {href: canvas.toDataURL(), download: `${plan.title} ${clock.time.toFixed(2)}.png`}).click();
    },
    full: () => document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen(),
    tweaks: () => body.toggle("narrow"),
    reset: () => setValues(plan.tweaks.map(({value}) => value)),
    sound: async () => {
        if (body.toggle("loud")) sound ??= await makeSound(plan).load(values).catch(fail);
        sounds();
    },
};
for (const name in press) on($(name), "click", () => isReady && press[name]());
on($("time"), "change", () => isReady && go(clamp(Number.isNaN(+$("time").value) ? clock.time : +$("time").value, 0, 1e9)));
on($("share"), "change", () => { holder.hold($("share").value); fit(true); });
const show = bindControls(document.querySelectorAll(".row"), plan.tweaks, (i, value) => setValues(values.with(i, value)));

// --- mouse, touch, keys

const did = event => { tape.add({...event, t: clock.time + 1e-9}); moved = true; };
let pointer = null;
on(canvas, "pointerdown pointermove pointerup pointercancel", event => {
    const {type, pointerId, offsetX, offsetY} = event, begins = type === "pointerdown", ends = /up|cancel/.test(type);
    if (begins ? pointer !== null || event.button : pointer !== pointerId) return;
    pointer = ends ? null : pointerId;
    if (begins) canvas.setPointerCapture(pointerId);
    const width = canvas.clientWidth, [w, h] = plan.size;  // that is whole, its height need not be
    did({mouse: [offsetX / width, 1 - offsetY / width * w / h], down: !ends});
});
on(window, "keydown keyup", event => {
    const {type, keyCode, target} = event, down = type === "keydown";
    if (event.repeat || keyCode > 255) return;
    if (down && (event.ctrlKey || event.metaKey || event.altKey || target.closest?.("input,select,button,summary"))) return;
    if (down && keyCode >= 32 && keyCode <= (plan.keyboard ? 40 : 32)) event.preventDefault();
    if (plan.keyboard) did({key: keyCode, down});
    else if (down && keyCode === 32) press.play();
});
on(window, "blur", () => plan.keyboard && did({}));  // keys are let go of elsewhere

// --- what happens to the page

on(document, "visibilitychange", () => {
    clock.last = null;
    sounds();
});
on(window, "hashchange", () => {
    const look = readLook(plan, location.hash);
    setValues(look.values);
    plays(!look.paused);
    if (isReady) seek(look.time);
});
on(canvas, "webglcontextlost", event => {
    event.preventDefault();
    isReady = false;
    ++seeking;
    say("The driver was lost.");
});
on(canvas, "webglcontextrestored", () => {
    seeking = 0;
    sound?.stop();  // its context was lost, too
    sound = body.remove("loud");
    start().catch(fail);
});

const fail = error => {
    say(error.message, "error");
    console.error(error.message);
};

$("full").hidden = !document.fullscreenEnabled;
show(values);
plays(!first.paused);
start().catch(fail);
requestAnimationFrame(tick60);
// For tests, and for pages around this one.
window.glint = {
    plan, clock, seek,
    get player() { return player; },
    get values() { return values; },
    get sound() { return sound; },
    again,
};

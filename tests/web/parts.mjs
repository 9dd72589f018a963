// The modules of an exported page, one by one, without a browser: node --test tests/web/parts.mjs
import test from "node:test";
import assert from "node:assert/strict";
const page = "../../host/offline/page/";
const {dateAfter, lastFrame, makeClock, playedFrame, timed} = await import(page + "clock.js");
const {stepsDue} = await import(page + "steps.js");
const {makeInput, makeTape} = await import(page + "input.js");
const {explain, placeOf} = await import(page + "errors.js");
const {fitted, format, parse, readLook, writeLook} = await import(page + "look.js");
const {declaration, definitions, textOf} = await import(page + "texts.js");
const {noiseBytes} = await import(page + "noise.js");
const {channelsTold} = await import(page + "channels.js");
const {rowsOf} = await import(page + "rows.js");
const {slideOf, valueAt} = await import(page + "controls.js");
const {makeHolder} = await import(page + "holder.js");
const {makePlayer} = await import(page + "player.js");

test("the last frame forgives times a rounding off a whole one", () => {
    assert.equal(lastFrame(7 / 60), 7);
    assert.equal(lastFrame(0.5 + 1e-3), 31);
    assert.equal(stepsDue(7 / 60, [1, 240]), 28);
});

test("ticks wrap at 2^32", () => {
    const tick = time => timed(time, 1, 0).iTick;
    assert.equal(tick(1), 65536);
    assert.equal(tick(65536 - 1 / 65536), 2 ** 32 - 1);
    assert.equal(tick(65536), 0);
});

test("midnight and the end of a year are crossed", () => {
    const day = (...date) => Date.UTC(...date) / 864e5;
    assert.deepEqual(dateAfter({day: day(2000, 11, 31), seconds: 86399}, 2), [2001, 0, 1, 1]);
    assert.deepEqual(dateAfter({day: day(2024, 1, 28), seconds: 0}, 86400), [2024, 1, 29, 0]);
});

test("frames of a playback end at its end, and settle there", () => {
    const plan = {day: 0, seconds: 0};
    assert.equal(playedFrame(plan, 0, 0.51).iTime, 0);
    assert.equal(playedFrame(plan, 31, 0.51).iTime, 0.51);
    assert.ok(playedFrame(plan, 31, 0.51).iTimeDelta < 1 / 60);
    assert.deepEqual([playedFrame(plan, 33, 0.51).iTime, playedFrame(plan, 33, 0.51).iFrame], [0.51, 33]);
});

test("a paused clock stands, and goes on without a jump", () => {
    const clock = makeClock(3);
    clock.advance(1000);
    clock.advance(1500);
    assert.equal(clock.time, 3.5);
    clock.playing = false;
    clock.advance(9000);
    clock.playing = true;
    clock.advance(20000);
    assert.equal(clock.time, 3.5);
});

test("the mouse has the site's signs", () => {
    const state = makeInput();
    assert.deepEqual(state.next([100, 50]).iMouse, [0, 0, 0, 0]);
    state.apply({mouse: [0.29, 0.5], down: true});
    assert.deepEqual(state.next([100, 50]).iMouse, [29, 25, 29, 25]);
    state.apply({mouse: [0.5, 0.6], down: true});
    assert.deepEqual(state.next([100, 50]).iMouse, [50, 30, 29, -25]);
    state.apply({mouse: [0.9, 0.9], down: false});
    assert.deepEqual(state.next([100, 50]).iMouse, [50, 30, -29, -25]);
});

test("a key is held, pressed in one frame, and toggled; repeats do not count", () => {
    const state = makeInput(), rows = () => { const {keys} = state.next([1, 1]); return [keys[65], keys[321], keys[577]]; };
    state.apply({key: 65, down: true});
    assert.deepEqual(rows(), [255, 255, 255]);
    state.apply({key: 65, down: true});
    assert.deepEqual(rows(), [255, 0, 255]);
    state.apply({key: 65, down: false});
    assert.deepEqual(rows(), [0, 0, 255]);
});

test("keys are let go of where nobody sees it", () => {
    const state = makeInput(), held = () => state.next([1, 1]).keys[65];
    state.apply({key: 65, down: true});
    assert.equal(held(), 255);
    state.apply({t: 1});
    assert.equal(held(), 0);
});

test("a frame that is drawn alone sees only what was done since the one before as new", () => {
    const tape = makeTape([{t: 0.2, key: 65, down: true}, {t: 0.2, mouse: [0.5, 0.5], down: true}, {t: 0.5, key: 66, down: true}]);
    const frame = playedFrame({day: 0, seconds: 0}, 30, 0.5);
    const {keys, iMouse} = tape.reader().input(frame.iTime, [10, 10], frame.from);
    assert.deepEqual([keys[65], keys[256 + 65], keys[256 + 66]], [255, 0, 255]);
    assert.deepEqual(iMouse, [5, 5, 5, -5]);
});

test("an event counts as new in one step, also where it comes while others are due", () => {
    const tape = makeTape([{t: 1, key: 32, down: true}]), reader = tape.reader();
    const pressed = (to, from) => reader.input(to, [1, 1], from).keys[256 + 32];
    assert.equal(pressed(0.5), 0);
    tape.add({t: 0.6, key: 33, down: true});
    assert.equal(tape.events[0].key, 33);
    assert.equal(pressed(1.0, 0.5), 255);
    assert.equal(pressed(1.5, 1.0), 0);
    assert.equal(tape.reader().input(3, [1, 1], 2).keys[256 + 32], 0);
});

const plan = {
    time: 2, files: ["a.frag", "b.glsl"], origins: [[1, 0, 1], [3, 1, 1], [5, 0, 4]],
    tweaks: [
        {name: "level", type: "float", value: [0.5], range: [0, 1]}, {name: "tint", type: "vec3", value: [0, 0.2, 1], colour: true},
        {name: "kind", type: "int", value: [1], names: ["off", "on", "bright"], range: [0, 2]},
        {name: "lit", type: "bool", value: [1], names: ["off", "on"], range: [0, 1]},
        {name: "size", type: "float", value: [10], range: [0.1, 1000], log: true}],
    lines: ["#version 300 es", "void f();", "glint_tweak0", "x", "y"],
};

test("errors stand at the line of their file", () => {
    assert.deepEqual([1, 2, 3, 4, 5, 9].map(line => placeOf(plan, line)),
        ["a.frag:1", "a.frag:2", "b.glsl:1", "b.glsl:2", "a.frag:4", "a.frag:8"]);
    assert.match(explain(plan, {name: "image"}, "ERROR: 0:12: 'x' : undeclared identifier\n\0", 8), /b\.glsl:2: error: 'x' : undeclared/);
    assert.match(explain(plan, {name: "image"}, "", 8), /does not say why/);
});

test("values are read as they are written", () => {
    for (const [tweak, text] of [[0, "0.25"], [1, "#0b3a53"], [2, "bright"], [3, "off"], [4, "123.5"]])
        assert.equal(format(plan.tweaks[tweak], parse(plan.tweaks[tweak], text)), text);
    assert.deepEqual(parse(plan.tweaks[0], "7"), [1]);
    assert.equal(parse(plan.tweaks[0], "x"), undefined);
    assert.equal(parse(plan.tweaks[1], "1,2"), undefined);
    assert.deepEqual(fitted(plan.tweaks[2], [7.4]), [2]);
});

test("the address keeps what differs from the preset", () => {
    const look = readLook(plan, "#t=12.5&paused&kind=bright&tint=%23ff0000&nobody=3&level=x");
    assert.deepEqual([look.time, look.paused, look.values[2], look.values[1], look.values[0]], [12.5, true, [2], [1, 0, 0], [0.5]]);
    assert.equal(writeLook(plan, look), "t=12.5&paused&tint=%23ff0000&kind=bright");
    assert.equal(writeLook(plan, readLook(plan, "")), "");
    assert.equal(readLook(plan, "#t=-1").time, 2);
    const named = {...plan, tweaks: [{...plan.tweaks[0], name: "t"}]}, look2 = {time: 3, paused: true, values: [[0.25]]};
    assert.equal(writeLook(named, look2), "t=3&paused&t.=0.25");
    assert.deepEqual(readLook(named, "#" + writeLook(named, look2)), look2);
});

test("tweaks are uniforms or constants, and lines are counted", () => {
    assert.equal(declaration(plan.tweaks[0]), "uniform float level;");
    assert.equal(declaration(plan.tweaks[0], [1]), "const float level = float(1.00000000e+0);");
    assert.equal(declaration(plan.tweaks[1], [0, 0.2, 1]), "const vec3 tint = vec3(0.00000000e+0,2.00000003e-1,1.00000000e+0);");
    assert.equal(declaration(plan.tweaks[3], [0]), "const bool lit = bool(0.00000000e+0);");
    assert.equal(declaration(plan.tweaks[0], [-0]), "const float level = float(-0.00000000e+0);");
    assert.equal(declaration({name: "n", type: "int", index: true}, [9]), "int n = int(9);");
    assert.equal(declaration(plan.tweaks[2], [2 ** 24 + 1]), "const int kind = int(16777217);");
    assert.equal(textOf(plan, {text: [[0, 1]], soft: [[3, 5]], first: 0}, null, true).text.split("\n").at(-1), "y");
    const {text, added} = textOf(plan, {text: [[0, 3], [4, 5]], first: 2}, null);
    assert.deepEqual(text.split("\n").filter(line => !line.startsWith("#define")), ["#version 300 es", "void f();", "glint_tweak0", "y"]);
    assert.equal(added, 2 + 2 * 5);
});

test("the text hears which tweaks are constants of 0, by which it may not divide", () => {
    const zero = value => definitions({name: "scale", type: "float"}, 3, value)[1];
    assert.deepEqual([[0], [1e-50], [2], undefined].map(zero), [1, 1, 0, 0].map(is => `#define glint_zero3 ${is}`));
});

test("a pass that asks is told the sizes and times of its channels", () => {
    const told = channelsTold([{size: [4, 2, 1], seconds: 2}, undefined, {size: [9, 9, 9], plays: true}, undefined], 5, input => input?.size ?? [0, 0, 0]);
    assert.deepEqual(told["iChannelTime[0]"], [1, 0, 5, 0]);
    assert.deepEqual(told["iChannelResolution[0]"].slice(0, 6), [4, 2, 1, 0, 0, 0]);
    assert.deepEqual([told["iCh2.size"], told["iCh2.loaded"], told["iCh3.loaded"]], [[9, 9, 9], 1, 0]);
});

test("noise has the host's bytes", () => {  // pcg3d of (0, 0, 0), (1, 0, 0), (0, 1, 0)
    assert.deepEqual([...noiseBytes({size: [2, 2, 1], faces: 1, channels: 4})].slice(0, 12), [155, 168, 63, 33, 161, 84, 123, 127, 26, 78, 116, 139]);
    assert.deepEqual([...noiseBytes({size: [2, 1, 1], faces: 1, channels: 1})], [155, 161]);
});

test("a sound has the rows of its block, and of its last round where it has settled", () => {
    const bytes = new Uint8Array(5 * 1024).map((_, i) => i >> 10), rowsAt = rowsOf(bytes, {seconds: 0.05, settled: 2});  // rounds of 3 blocks
    assert.deepEqual([0, 1, 2, 3, 4, 5, 6, 30].map(block => rowsAt({iTime: block / 60 + 1e-9})[0]), [0, 1, 2, 3, 4, 2, 3, 3]);
    assert.equal(rowsAt({iTime: 0.0499}).length, 1024);
});

test("a logarithmic slider goes by factors", () => {
    const size = plan.tweaks[4];
    assert.ok(Math.abs(slideOf(size, 10) - (Math.log(0.1) + Math.log(1000)) / 2) < 1e-12);
    assert.deepEqual(valueAt(size, `${Math.log(100)}`), [100]);
    assert.deepEqual(valueAt({...size, log: false}, "15"), [15]);
});

test("the resolution falls where frames are slow, and is left alone where it is chosen", () => {
    const holder = makeHolder();
    for (let i = 0; i < 20; ++i) holder.took(100);
    assert.ok(holder.share < 0.8);
    holder.hold("0.5");
    for (let i = 0; i < 20; ++i) holder.took(100);
    assert.equal(holder.share, 0.5);
});

test("a frame that took long between quick ones is no reason to draw fewer pixels, a few of them are", () => {
    const holder = makeHolder();
    for (const ms of [0, 17, 17, 1000, 17, 17, 0, 17, 17, 1000, 17, 17, 17, 17, 17]) holder.took(ms);
    assert.equal(holder.share, 1);
    for (let i = 0; i < 5; ++i) holder.took(1000);
    assert.equal(holder.share, 0.5);
});

// WebGL that draws nothing and counts.
function countingGl(also) {
    const draws = [];
    let program;
    const known = {useProgram: p => program = p, drawArrays: () => draws.push(program), isContextLost: () => false, ...also};
    return {draws, gl: new Proxy(known, {get: (_, name) => known[name] ?? (/^[A-Z0-9_]+$/.test(name) ? name : () => ({}))})};
}
const linked = (player, reads) => new Map(player.passes.map((pass, i) => [pass,
    {id: pass.name, uniforms: pass.still ? [] : [{send: "uniform1fv", name: "iTime"}],
     samplers: reads[i].map(k => ({input: player.inputs[k]}))}]));
const kept = {formats: [["rgba16f"]], sides: 1, outputs: 1, faces: 1}, image = {name: "image", faces: 1}, size = [4, 4];
const buffer = pass => ({source: "buffer", pass, output: 0, modes: []});

test("what has not changed is not drawn again, and only what is carried on is advanced", () => {
    const {gl, draws} = countingGl();
    const passes = [{...kept, name: "fixed", still: true, size}, {...kept, name: "trail", size, sides: 2}, image];
    const player = makePlayer(gl, {tweaks: [], inputs: [buffer(0), buffer(1)]}, passes);
    player.use(linked(player, [[], [1], [0, 1]]));
    assert.deepEqual([player.isStateful, player.passes.map(p => p.state)], [true, [false, true, false]]);
    const frame = iTime => ({iTime, keys: new Uint8Array(768)});
    player.draw(frame(0), true);
    player.draw(frame(1));
    assert.equal(player.draw(frame(1)), true);  // its own last frame is new to the trail
    assert.deepEqual(draws, ["trail", "fixed", "trail", "image", "trail", "image"]);
});

test("another size begins the buffers of a share of the picture anew, and leaves the others", () => {
    const {gl, draws} = countingGl();
    const passes = [{...kept, name: "own", still: true, size}, {...kept, name: "half", still: true, scale: 0.5}, {...image, still: true}];
    const player = makePlayer(gl, {tweaks: [], inputs: [buffer(0), buffer(1)]}, passes), frame = {iTime: 0, keys: new Uint8Array(768)};
    player.size = [8, 8];
    player.use(linked(player, [[], [], [0, 1]]));
    player.draw(frame);
    assert.deepEqual(player.passes.map(pass => pass.pixels), [[4, 4], [4, 4], [8, 8]]);
    player.resize([5, 3]);
    player.draw(frame);
    assert.deepEqual(player.passes.map(pass => pass.pixels), [[4, 4], [3, 2], [5, 3]]);
    assert.deepEqual(draws, ["own", "half", "image", "half", "image"]);
});

test("passes of one step length run together, once for each step that is due", () => {
    const {gl, draws} = countingGl();
    const step = [1, 4], passes = [{...kept, name: "a", size, step}, {...kept, name: "b", size, step}, image];
    const player = makePlayer(gl, {tweaks: [], inputs: [buffer(0), buffer(1)]}, passes);
    player.use(linked(player, [[1], [0], [0, 1]]));
    player.draw({iTime: 0.5, keys: new Uint8Array(768)});
    assert.deepEqual(draws, ["a", "b", "a", "b", "image"]);
    draws.length = 0;
    player.draw({iTime: 100.5, longest: 0.5, keys: new Uint8Array(768)});
    assert.equal(draws.length, 5);
});

test("the first format is taken for which the browser has all, and another one is told", () => {
    const formats = [["rgba32f", "draws", "filters"], ["rgba16f", "draws"], ["rgba8"]];
    const takes = has => {
        const told = [], {gl} = countingGl({getExtension: name => has.includes(name)});
        const player = makePlayer(gl, {tweaks: [], inputs: []}, [{...kept, ...image, formats, size}], text => told.push(text));
        player.use(linked(player, [[]]));
        return told.join();
    };
    assert.equal(takes(["draws", "filters"]), "");
    assert.match(takes(["draws"]), /image: rgba16f in place of rgba32f/);
    assert.match(takes(["filters"]), /image: rgba8 in place of rgba32f/);
});

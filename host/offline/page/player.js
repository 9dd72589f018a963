// A planned graph and a frame become pixels. Order, sizes, formats and fillers were decided by the host; which passes a
// look needs, and which carry anything into a later frame, is asked of its linked programs, as the host does.
import {tick, stepsDue} from "./clock.js";
import {explain} from "./errors.js";
import {textOf} from "./texts.js";
import {inflate, noiseBytes} from "./fillers.js";
import {Analyser} from "./analyser.js";
import {Buffer, makeTexture} from "./buffer.js";

const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

// By the number of a uniform's type: how it is sent, and how many numbers it has.
const SEND = {0x1406: ["1f", 1], 0x8B50: ["2f", 2], 0x8B51: ["3f", 3], 0x8B52: ["4f", 4], 0x1404: ["1i", 1], 0x8B56: ["1i", 1], 0x1405: ["1ui", 1]};
const KIND = {sampler2D: "2D", sampler3D: "3D", samplerCube: "CUBE_MAP"};
const EMPTY = {0x8B5E: "2D", 0x8B5F: "3D", 0x8B60: "CUBE_MAP"};

const BUILTIN = {
    iTime: f => [f.time], iTimeDelta: f => [f.delta], iFrameRate: f => [f.rate], iFrame: f => [f.frame],
    iMouse: f => f.mouse, iDate: f => f.date, iSampleRate: () => [44100], iTick: f => [tick(f.time)],
    iResolution: (f, pass) => [...pass.size, 1],
};
Object.assign(BUILTIN, {iGlobalTime: BUILTIN.iTime, u_time: BUILTIN.iTime, u_resolution: BUILTIN.iResolution, u_mouse: BUILTIN.iMouse});

export class Player {
    // `fell` hears what this browser cannot do as it should.
    constructor(gl, plan, passes, fell = () => {}) {
        Object.assign(this, {gl, plan, live: [], values: plan.tweaks.map(t => t.value), samplers: {}, empty: {}, steps: {}, size: [1, 1]});
        this.can = {draw: gl.getExtension("EXT_color_buffer_float"), half: gl.getExtension("EXT_color_buffer_half_float"),
            filter: gl.getExtension("OES_texture_float_linear"), wait: gl.getExtension("KHR_parallel_shader_compile")};
        this.fell = fell;
        this.inputs = plan.inputs.map(input => ({...input, version: 1}));
        this.passes = passes.map((pass, index) => ({...pass, index}));
        this.root = this.passes.at(-1);
        for (const kind of ["2D", "3D", "CUBE_MAP"]) this.empty[kind] = makeTexture(gl, kind, "RGBA8", [1, 1, 1]);
        gl.disable(gl.DITHER);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    }

    // 32-bit floats where the browser draws, and where it must, filters them; else what comes nearest.
    formatOf(format, isFiltered, isDrawn, what) {
        let wanted = format;
        if (format.endsWith("32f") && (isDrawn && !this.can.draw || isFiltered && !this.can.filter)) wanted = format.replace("32f", "16f");
        if (isDrawn && wanted.endsWith("16f") && !this.can.draw && !this.can.half) wanted = "rgba8";
        if (wanted !== format) this.fell(`${what}: ${wanted} instead of ${format} as this browser does not ${isDrawn && !this.can.draw ? "draw" : "filter"}`);
        return wanted;
    }

    // Links the programs of a look, and in their turn those that fill what they read; `values` are constants, or null.
    async link(values) {
        const linked = new Map(), {gl} = this;
        for (let wanted = [this.root]; wanted.length;) {
            const round = wanted.map(pass => [pass, this.start(pass, values)]);
            for (const [pass, program] of round) {
                while (this.can.wait && !gl.isContextLost() && !gl.getProgramParameter(program.id, this.can.wait.COMPLETION_STATUS_KHR))
                    await new Promise(done => setTimeout(done, 5));
                this.inspect(pass, program);
                linked.set(pass, program);
            }
            const read = [...linked.values()].flatMap(p => p.samplers.map(s => this.passes[s.input?.pass])).filter(Boolean);
            wanted = [...new Set(read)].filter(pass => !linked.has(pass));
        }
        await Promise.all([...linked].flatMap(([pass, p]) => [...p.samplers.map(s => s.input), ...Object.values(pass.channels ?? {}).map(i => this.inputs[i])])
            .map(input => input && this.fill(input)));
        return linked;
    }

    start(pass, values) {
        const {gl} = this, {text, added} = textOf(this.plan, pass, values), id = gl.createProgram();
        const shaders = [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, text]].map(([kind, source]) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            gl.attachShader(id, shader);
            return shader;
        });
        gl.linkProgram(id);
        return {id, shaders, added};
    }

    // Asks the linked program what it really reads.
    inspect(pass, program) {
        const {gl} = this, {id, shaders} = program;
        if (!gl.getProgramParameter(id, gl.LINK_STATUS) && !gl.isContextLost())
            throw new Error(explain(this.plan, pass, gl.getShaderInfoLog(shaders[1]) || gl.getProgramInfoLog(id) || "", program.added));
        shaders.forEach(shader => gl.deleteShader(shader));
        program.uniforms = [];
        program.samplers = [];
        gl.useProgram(id);
        for (let i = 0; i < gl.getProgramParameter(id, gl.ACTIVE_UNIFORMS); ++i) {
            const {name, type, size} = gl.getActiveUniform(id, i), location = gl.getUniformLocation(id, name);
            if (SEND[type]) {
                const [send, count] = SEND[type];
                program.uniforms.push({location, send: `uniform${send}v`, name, value: this.valueOf(name, pass, count)});
            } else {
                const unit = program.samplers.length, known = name.replace(/^iCh(\d)\.sampler$/, "iChannel$1");
                gl.uniform1iv(location, Array(size).fill(unit));
                program.samplers.push({input: this.inputs[pass.samplers?.[known]], kind: EMPTY[type]});
            }
        }
    }

    // The numbers of a uniform, as a function of the frame.
    valueOf(name, pass, count) {
        const tweak = this.plan.tweaks.findIndex(t => t.name === name);
        if (tweak >= 0) return () => this.values[tweak];
        if (BUILTIN[name]) return f => BUILTIN[name](f, pass).slice(0, count);
        const [, one, part] = name.match(/^iCh(\d)\.(\w+)/) ?? [], channel = i => this.inputs[pass.channels?.[i]];
        if (part === "size") return () => this.sizeOf(channel(one));
        if (part === "time") return f => [this.timeOf(channel(one), f.time)];
        if (part === "loaded") return () => [+(this.sizeOf(channel(one))[0] > 0)];
        if (name.startsWith("iChannelTime")) return f => [0, 1, 2, 3].map(i => this.timeOf(channel(i), f.time));
        if (name.startsWith("iChannelResolution")) return () => [0, 1, 2, 3].flatMap(i => this.sizeOf(channel(i)));
        return () => Array(count).fill(0);
    }
    sizeOf(input) {
        if (!input) return [0, 0, 0];
        if (input.source === "buffer") return [...this.scaled(input), 1];
        if (input.source === "keyboard") return [256, 3, 1];
        if (input.source === "sound") return [512, 2, 1];
        return input.type === "samplerCube" ? [input.size[0], input.size[0], 1] : input.size;
    }
    timeOf(input, time) { return input?.seconds ? time % input.seconds : input?.plays ? time : 0; }
    scaled({size, scale = 1}) { return size ?? this.size.map(s => Math.max(1, Math.floor(s * scale + 0.5))); }

    // Makes the texture of what is no buffer.
    async fill(input) {
        const {gl} = this, {source, size, channels, floats} = input;
        if (input.texture || source === "buffer" || source === "none") return;
        const kind = KIND[input.type], mipmaps = input.filter === "mipmap";
        const data = input.data && await inflate(input.data);
        if (source === "keyboard") return input.texture = makeTexture(gl, kind, "R8", [256, 3]);
        if (source === "sound") {
            input.analyser = new Analyser(new Int16Array(data));
            return input.texture = makeTexture(gl, kind, "R8", [512, 2]);
        }
        const texels = source === "noise" ? noiseBytes(size, channels) : floats ? new Float32Array(data) : new Uint8Array(data);
        const name = ["r", "rg", "rgb", "rgba"][channels - 1], format = floats ? this.formatOf(name + "32f", input.filter !== "nearest", false, "a picture") : name + "8";
        input.texture = makeTexture(gl, kind, format.toUpperCase(), size, mipmaps);
        const layout = [[gl.RED, gl.RG, gl.RGB, gl.RGBA][channels - 1], floats ? gl.FLOAT : gl.UNSIGNED_BYTE], [w, h, depth] = size;
        if (kind === "3D") gl.texSubImage3D(gl.TEXTURE_3D, 0, 0, 0, 0, w, h, depth, ...layout, texels);
        else if (kind === "2D") gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, w, h, ...layout, texels);
        else for (let face = 0, part = texels.length / 6; face < 6; ++face)
            gl.texSubImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, 0, 0, w, h, ...layout, texels.subarray(face * part, face * part + part));
        if (mipmaps) gl.generateMipmap(gl["TEXTURE_" + kind]);
    }

    // From the next frame on these are drawn.
    use(linked) {
        const {gl} = this;
        for (const pass of this.passes) {
            if (pass.program && pass.program !== linked.get(pass)) gl.deleteProgram(pass.program.id);
            pass.program = linked.get(pass);
            pass.drawn = false;
        }
        const live = this.live = this.passes.filter(pass => pass.program), state = new Set();
        for (const pass of live) {
            pass.reads = new Set(pass.program.samplers.map(s => this.passes[s.input?.pass]).filter(Boolean));
            pass.isBack = [...pass.reads].some(other => other.index >= pass.index);
        }
        const feed = pass => state.has(pass) || state.add(pass) && pass.reads.forEach(feed);
        for (const pass of live)
            if (pass.step || live.some(reader => reader.index <= pass.index && reader.reads.has(pass))) feed(pass);
        for (const pass of live) pass.state = state.has(pass);
        this.isStateful = live.some(pass => pass.isBack || pass.step);
        this.keepsSize = live.some(pass => pass.scale && !pass.cube && (pass.state || pass.isBack));
        for (const pass of this.live) {
            pass.size = pass === this.root && !pass.size ? this.size : this.scaled(pass);
            if (pass.buffer || !pass.format) continue;
            const isFiltered = this.inputs.some(i => i.source === "buffer" && i.pass === pass.index && i.filter !== "nearest");
            const format = this.formatOf(pass.format, isFiltered, true, pass.name);
            pass.isScaled = !pass.cube && pass.scale !== undefined;
            pass.buffer = new Buffer(gl, {...pass, format});
        }
    }

    resize(size) {
        this.size = size;
        for (const pass of this.live) {
            if (pass === this.root && !pass.format) { pass.size = size; pass.drawn = false; }
            if (!pass.isScaled) continue;
            pass.size = this.scaled({scale: pass.scale});
            if (`${pass.size}` === `${pass.buffer.shape.size}`) continue;
            pass.buffer.resize(pass.size);
            pass.drawn = false;
        }
    }

    // Buffers to 0 and simulations to their start.
    reset() {
        for (const pass of this.passes) { pass.buffer?.free(); pass.buffer = null; }
        this.steps = {};
        this.use(new Map(this.live.map(pass => [pass, pass.program])));
    }

    instant({time, keys}) {
        const {gl} = this;
        for (const input of this.inputs) {
            if (!input.texture) continue;
            const rows = input.analyser?.rowsAt(time) ?? (input.source === "keyboard" && keys);
            if (!rows || input.rows === rows || input.rows?.every((v, i) => v === rows[i])) continue;
            input.rows = rows;
            ++input.version;
            gl.bindTexture(gl.TEXTURE_2D, input.texture);
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, rows === keys ? 256 : 512, rows === keys ? 3 : 2, gl.RED, gl.UNSIGNED_BYTE, rows);
        }
    }

    // Draws whatever has changed, or only what later frames depend on. True when the picture is new.
    draw(frame, onlyState) {
        this.instant(frame);
        this.isNew = false;
        const stepped = new Set();
        for (const pass of this.live) {
            if (onlyState && !pass.state) continue;
            if (!pass.step) this.drawPass(pass, frame);
            else if (!stepped.has(`${pass.step}`)) { stepped.add(`${pass.step}`); this.drawSteps(pass.step, frame); }
        }
        return this.isNew;
    }

    // Passes of one step length run together, each step all of them, where the first of them stands.
    drawSteps(step, frame) {
        const [n, d] = step, group = this.live.filter(pass => `${pass.step}` === `${step}`);
        const clock = this.steps[step] ??= {done: 0, reader: frame.tape?.reader()};
        const due = stepsDue(frame.time, step), most = Math.max((frame.longest ?? Infinity) * d / n, 1);
        if (clock.done > due) clock.done = due;
        clock.done = Math.max(clock.done, Math.ceil(due - most));
        const hasEvents = frame.tape?.events.length;
        for (; clock.done < due; ++clock.done) {
            const time = (clock.done + 1) * n / d, from = clock.done ? clock.done * n / d : -Infinity;
            const inner = {...frame, time, delta: n / d, rate: d / n, frame: clock.done};
            if (hasEvents) Object.assign(inner, clock.reader.input(time, this.size, from));
            this.instant(inner);
            for (const pass of group) this.drawPass(pass, inner, true);
        }
        this.instant(frame);
    }

    drawPass(pass, frame, force) {
        const {gl} = this, {program, buffer} = pass;
        gl.useProgram(program.id);
        let isNew = force || !pass.drawn, face;
        for (const uniform of program.uniforms) {
            if (uniform.name === "glint_face") { face = uniform.location; continue; }
            const value = uniform.value(frame), text = String(value);
            if (uniform.sent === text) continue;
            uniform.sent = text;
            gl[uniform.send](uniform.location, value);
            isNew = true;
        }
        for (const sampler of program.samplers) {
            const version = (this.passes[sampler.input?.pass]?.buffer ?? sampler.input)?.version;
            if (sampler.version !== version) isNew = true;
            sampler.version = version;
        }
        if (!isNew) return;
        pass.drawn = true;
        if (pass === this.root) this.isNew = true;
        this.bind(program);
        gl.viewport(0, 0, ...pass.size);
        for (let i = 0; i < (pass.cube ? 6 : 1); ++i) {
            if (face) gl.uniform1i(face, i);
            gl.bindFramebuffer(gl.FRAMEBUFFER, buffer?.target(i) ?? null);
            gl.drawArrays(gl.TRIANGLES, 0, 3);
        }
        gl.activeTexture(gl.TEXTURE0);
        buffer?.finish();
    }

    bind({samplers}) {
        const {gl} = this;
        samplers.forEach(({input, kind}, unit) => {
            const texture = this.passes[input?.pass]?.buffer?.texture(input.output) ?? input?.texture;
            gl.activeTexture(gl.TEXTURE0 + unit);
            if (kind) gl.bindTexture(gl["TEXTURE_" + kind], texture ?? this.empty[kind]);
            gl.bindSampler(unit, texture ? this.samplerOf(input) : null);
        });
    }

    // How a reader filters and wraps.
    samplerOf({filter, wrap}) {
        const {gl} = this, key = filter + wrap;
        if (this.samplers[key]) return this.samplers[key];
        const sampler = this.samplers[key] = gl.createSampler();
        const mode = {clamp: gl.CLAMP_TO_EDGE, repeat: gl.REPEAT, mirror: gl.MIRRORED_REPEAT}[wrap];
        for (const axis of ["S", "T", "R"]) gl.samplerParameteri(sampler, gl["TEXTURE_WRAP_" + axis], mode);
        gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, filter === "nearest" ? gl.NEAREST : gl.LINEAR);
        gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, {nearest: gl.NEAREST, linear: gl.LINEAR, mipmap: gl.LINEAR_MIPMAP_LINEAR}[filter]);
        return sampler;
    }

    // Until the GPU is done.
    async wait() {
        const {gl} = this, fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        while (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise(done => setTimeout(done));
        gl.deleteSync(fence);
    }
}

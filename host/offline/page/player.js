// A planned graph and a frame become pixels. Order, sizes, formats and fillers were decided by the host; which passes a
// look needs, and which carry anything into a later frame, is asked of its linked programs, as the host does.
import {explain} from "./errors.js";
import {textOf} from "./texts.js";
import {noiseBytes} from "./noise.js";
import {channelsTold} from "./channels.js";
import {makeSteps} from "./steps.js";
import {makeAnalyser} from "./analyser.js";
import {makeBuffer, makeTexture} from "./buffer.js";

const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID % 2 * 4 - 1, gl_VertexID / 2 * 4 - 1, 0, 1); }`;

// By the number of a uniform's type: how it is sent, or the kind of the texture that it reads.
const SEND = {0x1406: "1f", 0x8B50: "2f", 0x8B51: "3f", 0x8B52: "4f", 0x1404: "1i", 0x8B56: "1i", 0x1405: "1ui"};
const KIND = {0x8B5E: "2D", 0x8B5F: "3D", 0x8B60: "CUBE_MAP"};

export const pause = ms => new Promise(done => setTimeout(done, ms));

// 32-bit floats where the browser draws, and where it must, filters them; else what comes nearest.
export function formatOf(can, format, isFiltered, isDrawn) {
    if (format.endsWith("32f") && (isDrawn && !can.draw || isFiltered && !can.filter)) format = format.replace("32f", "16f");
    return isDrawn && format.endsWith("16f") && !can.draw && !can.half ? "rgba8" : format;
}

// `fell` hears what this browser cannot do as it should.
export function makePlayer(gl, plan, planned, fell) {
    const [draw, half, filter, wait, named] = ["EXT_color_buffer_float", "EXT_color_buffer_half_float", "OES_texture_float_linear",
        "KHR_parallel_shader_compile", "WEBGL_debug_renderer_info"].map(name => gl.getExtension(name));
    const isSoftware = /llvmpipe|softpipe|SwiftShader/i.test(gl.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    const inputs = plan.inputs.map(input => ({...input, version: 0})), passes = planned.map(pass => ({...pass})), root = passes.at(-1);
    const empty = {};
    let drawSteps, isNew;
    for (const kind of Object.values(KIND)) empty[kind] = makeTexture(gl, kind, "RGBA8", [1, 1, 1]);
    gl.disable(gl.DITHER);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);

    const pixelsOf = ({size, scale = 1}) => size ?? player.size.map(s => Math.max(1, Math.floor(s * scale + 0.5)));
    const sizeOf = input => !input ? [0, 0, 0] : input.source === "buffer" ? [...pixelsOf(input), 1] : input.size;

    function formatFor(what, format, isFiltered, isDrawn) {
        const taken = formatOf({draw, half, filter}, format, isFiltered, isDrawn);
        if (taken !== format) fell?.(`${what}: ${taken} instead of ${format}, of which this browser does not do all`);
        return taken;
    }

    // Links the programs of a look, by the numbers of their passes; `values` are constants, or null.
    async function link(values) {
        const linked = [], needed = new Set(), need = i => { linked[i] ??= start(passes[i], values); needed.add(i); };
        need(passes.length - 1);
        for (const i of needed) {
            while (wait && !gl.isContextLost() && !gl.getProgramParameter(linked[i].id, wait.COMPLETION_STATUS_KHR)) await pause(5);
            inspect(passes[i], linked[i]);
            for (const {input} of linked[i].samplers) if (input?.source === "buffer") need(input.pass);
        }
        const read = [...needed].flatMap(i => [...linked[i].samplers.map(s => s.input), ...(passes[i].channels ?? []).map(k => inputs[k])]);
        await Promise.all(read.map(input => input?.format && (input.filled ??= fill(input))));
        return linked;
    }

    function start(pass, values) {
        const {text, added} = textOf(plan, pass, values, isSoftware), id = gl.createProgram();
        const shaders = [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, text]].map(([kind, source]) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            gl.attachShader(id, shader);
            return shader;
        });
        gl.linkProgram(id);
        return {id, shaders, added, uniforms: [], samplers: []};
    }

    // Asks the linked program what it really reads.
    function inspect(pass, {id, shaders, added, uniforms, samplers}) {
        if (!gl.getProgramParameter(id, gl.LINK_STATUS) && !gl.isContextLost())
            throw new Error(explain(plan, pass, gl.getShaderInfoLog(shaders[1]) || gl.getProgramInfoLog(id) || "", added));
        gl.useProgram(id);
        for (let i = 0; i < gl.getProgramParameter(id, gl.ACTIVE_UNIFORMS); ++i) {
            const {name, type, size} = gl.getActiveUniform(id, i), location = gl.getUniformLocation(id, name), unit = samplers.length;
            if (SEND[type]) uniforms.push({location, name, send: `uniform${SEND[type]}v`});
            else {
                gl.uniform1iv(location, Array(size).fill(unit));
                samplers.push({input: inputs[pass.samplers?.[name]], kind: KIND[type]});
            }
        }
    }

    // A data: address of deflated bytes.
    async function inflate(address) {
        const stream = (await fetch(address)).body.pipeThrough(new DecompressionStream("deflate"));
        return new Response(stream).arrayBuffer();
    }

    // Makes the texture of what is no buffer.
    async function fill(input) {
        const {source, kind, format, layout, size, faces, floats} = input, mipmaps = input.filter === "mipmap", target = gl["TEXTURE_" + kind];
        const data = input.data && await inflate(input.data);
        const texture = makeTexture(gl, kind, formatFor("a picture", format, floats && input.filter !== "nearest"), size, mipmaps);
        if (source === "sound") input.rowsAt = makeAnalyser(new Int16Array(data));
        else if (source !== "keyboard") {
            const texels = source === "noise" ? noiseBytes(input) : floats ? new Float32Array(data) : new Uint8Array(data);
            const from = [layout, floats ? gl.FLOAT : gl.UNSIGNED_BYTE];
            if (kind === "3D") gl.texSubImage3D(target, 0, 0, 0, 0, ...size, ...from, texels);
            else for (let face = 0; face < faces; ++face)
                gl.texSubImage2D(faces > 1 ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : target, 0, 0, 0, size[0], size[1], ...from,
                    texels.subarray(texels.length / faces * face));
        }
        if (mipmaps) gl.generateMipmap(target);
        input.texture = texture;
    }

    // From the next frame on these are drawn.
    function use(linked) {
        passes.forEach((pass, i) => {
            if (pass.program && pass.program !== linked[i]) gl.deleteProgram(pass.program.id);
            pass.program = linked[i];
            pass.drawn = false;
        });
        const live = player.live = passes.filter(pass => pass.program), reads = pass => pass.program.samplers.map(s => passes[s.input?.pass]);
        // What a pass reads that is drawn with it or behind it is of the frame before: later frames depend on that, and on all it reads.
        const state = new Set(live.flatMap((reader, i) => reader.step ? reader : reads(reader).filter(pass => live.indexOf(pass) >= i)));
        for (const pass of state) reads(pass).forEach(other => other && state.add(other));
        live.forEach(pass => pass.state = state.has(pass));
        shape();
    }

    // A buffer of another size begins anew: what carries anything on has the size that it began with.
    function shape() {
        for (const pass of player.live) {
            const size = pixelsOf(pass);
            if (`${size}` !== `${pass.pixels}`) free(pass);
            pass.pixels = size;
            if (!pass.format) continue;
            const isFiltered = inputs.some(i => passes[i.pass] === pass && i.filter !== "nearest");
            pass.buffer ??= makeBuffer(gl, {...pass, size, format: formatFor(pass.name, pass.format, isFiltered, true)});
        }
    }
    function free(pass) {
        pass.buffer?.free();
        pass.buffer = null;
        pass.drawn = false;
    }

    // What is new in what no pass draws.
    function instant({iTime, keys}) {
        for (const input of inputs) {
            const rows = input.texture && (input.rowsAt?.(iTime) ?? (input.source === "keyboard" && keys)), text = `${rows}`;
            if (!rows || input.rows === text) continue;
            input.rows = text;
            ++input.version;
            gl.bindTexture(gl.TEXTURE_2D, input.texture);
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, input.size[0], input.size[1], gl.RED, gl.UNSIGNED_BYTE, rows);
        }
    }

    function drawPass(pass, frame, force) {
        const {program, buffer} = pass, {pixels, channels} = pass;
        const own = {iResolution: [...pixels, 1], u_resolution: pixels, ...channels && channelsTold(channels.map(i => inputs[i]), frame.iTime, sizeOf)};
        gl.useProgram(program.id);
        let isDue = force || !pass.drawn, face;
        for (const uniform of program.uniforms) {
            const {name, location} = uniform, tweak = plan.tweaks.findIndex(t => t.name === name);
            if (name === "glint_face") face = location;
            const value = [player.values[tweak] ?? own[name] ?? frame[name] ?? []].flat(), text = `${value}`;
            if (uniform.sent === text || !text) continue;
            uniform.sent = text;
            gl[uniform.send](location, value);
            isDue = true;
        }
        for (const sampler of program.samplers) {
            const {version} = passes[sampler.input?.pass]?.buffer ?? sampler.input ?? sampler;
            if (sampler.version !== version) isDue = true;
            sampler.version = version;
        }
        if (!isDue) return;
        pass.drawn = true;
        isNew ||= pass === root;
        program.samplers.forEach(({input, kind}, unit) => {
            const texture = passes[input?.pass]?.buffer?.texture(input.output) ?? input?.texture;
            gl.activeTexture(gl.TEXTURE0 + unit);
            if (kind) gl.bindTexture(gl["TEXTURE_" + kind], texture ?? empty[kind]);
            gl.bindSampler(unit, texture ? samplerOf(input) : null);
        });
        gl.viewport(0, 0, ...pixels);
        for (let i = 0; i < (pass.cube ? 6 : 1); ++i) {
            if (face) gl.uniform1i(face, i);
            gl.bindFramebuffer(gl.FRAMEBUFFER, buffer?.target(i) ?? null);
            gl.drawArrays(gl.TRIANGLES, 0, 3);
        }
        gl.activeTexture(gl.TEXTURE0);
        buffer?.finish();
    }

    // How a reader filters and wraps: the host wrote what WebGL calls it.
    function samplerOf(input) {
        if (!input.sampler) {
            input.sampler = gl.createSampler();
            for (const [name, value] of input.modes) gl.samplerParameteri(input.sampler, name, value);
        }
        return input.sampler;
    }

    const player = {
        gl, root, passes, inputs, link, use, live: [], values: [], size: [1, 1],
        get isStateful() { return player.live.some(pass => pass.state); },
        get keepsSize() { return player.live.some(pass => pass.state && pass.scale); },
        resize(size) {
            player.size = size;
            shape();
        },
        // Buffers to 0 and simulations to their start.
        reset() {
            passes.forEach(free);
            drawSteps = null;
            shape();
        },
        // Draws whatever has changed, or only what later frames depend on. True when the picture is new.
        draw(frame, onlyState) {
            instant(frame);
            isNew = false;
            const stepped = new Set();
            for (const pass of player.live) {
                const step = `${pass.step ?? ""}`;
                if (onlyState && !pass.state || stepped.has(step)) continue;
                if (!step) drawPass(pass, frame);
                else { stepped.add(step); (drawSteps ??= makeSteps(player, instant, drawPass))(pass.step, frame); }
            }
            return isNew;
        },
        // Until the GPU is done.
        async wait() {
            const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
            gl.flush();
            while (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) await pause();
            gl.deleteSync(fence);
        },
    };
    return player;
}

// A planned graph and a frame become pixels. Order, sizes, formats and fillers were decided by the host; which passes a
// look needs, and which carry anything into a later frame, is asked of its linked programs, as the host does.
import {floor, max} from "./arithmetic.js";
import {explain} from "./errors.js";
import {textOf} from "./texts.js";
import {noiseBytes} from "./noise.js";
import {channelsTold} from "./channels.js";
import {makeSteps} from "./steps.js";
import {rowsOf} from "./rows.js";
import {makeBuffer, makeTexture} from "./buffer.js";

// How a uniform is sent, by the number of its type. All others are samplers.
const SEND = {0x1406: "1f", 0x8B50: "2f", 0x8B51: "3f", 0x8B52: "4f", 0x1404: "1i", 0x8B56: "1i", 0x1405: "1ui"};

const UNMASKED_RENDERER = 0x9246;

export const pause = ms => new Promise(done => setTimeout(done, ms));

// `fell` hears what this browser cannot do as it should.
export const makePlayer = (gl, plan, planned, fell) => {
    const has = name => gl.getExtension(name), isPatient = has("KHR_parallel_shader_compile");
    const isSoftware = /pipe|SwiftShader/i.test(gl.getParameter(has("WEBGL_debug_renderer_info") ? UNMASKED_RENDERER : gl.RENDERER));
    const passes = planned.map(pass => ({...pass})), root = passes.at(-1);
    const inputs = plan.inputs.map(input => {
        const sampler = gl.createSampler();
        for (const mode of input.modes) gl.samplerParameteri(sampler, ...mode);
        return {...input, sampler, version: 0, from: passes[input.pass]};
    });
    const compile = (kind, source) => {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        return shader;
    };
    const vertex = compile(gl.VERTEX_SHADER, plan.vertex);
    let drawSteps, isNew, last;
    gl.disable(gl.DITHER);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);

    const pixelsOf = ({size, scale}) => size ?? player.size.map(s => max(1, floor(s * (scale ?? 1) + 0.5)));
    const sizeOf = input => input?.source === "buffer" ? [...pixelsOf(input), 1] : input?.size ?? [0, 0, 0];

    // The host's first choice, or the first for which the browser has all that it needs.
    const formatOf = (what, formats) => {
        const [taken] = formats.find(([, ...needs]) => needs.every(has));
        if (taken !== formats[0][0]) fell?.(`${what}: ${taken} in place of ${formats[0].join(" with ")}`);
        return taken.toUpperCase();
    };

    // Links the programs of a look, by their passes; `values` are constants, or null.
    const link = async values => {
        const linked = new Map(), need = pass => linked.has(pass) || linked.set(pass, start(pass, values));
        need(root);
        for (const [pass, program] of linked) {
            while (isPatient && !gl.isContextLost() && !gl.getProgramParameter(program.id, gl.COMPLETION_STATUS_KHR)) await pause(5);
            inspect(pass, program);
            for (const {input} of program.samplers) {
                if (input?.from) need(input.from);
                else if (input) await (input.filled ??= fill(input));
            }
        }
        return linked;
    };

    const start = (pass, values) => {
        const {text, added} = textOf(plan, pass, values, isSoftware), id = gl.createProgram(), shader = compile(gl.FRAGMENT_SHADER, text);
        gl.attachShader(id, vertex);
        gl.attachShader(id, shader);
        gl.linkProgram(id);
        return {id, shader, added, uniforms: [], samplers: []};
    };

    // Asks the linked program what it really reads.
    const inspect = (pass, {id, shader, added, uniforms, samplers}) => {
        if (!gl.getProgramParameter(id, gl.LINK_STATUS) && !gl.isContextLost())
            throw Error(explain(plan, pass, gl.getShaderInfoLog(shader) || gl.getProgramInfoLog(id), added));
        gl.useProgram(id);
        for (let i = 0; i < gl.getProgramParameter(id, gl.ACTIVE_UNIFORMS); ++i) {
            const {name, type, size} = gl.getActiveUniform(id, i), location = gl.getUniformLocation(id, name);
            if (SEND[type]) uniforms.push({location, name, send: `uniform${SEND[type]}v`, count: size * parseInt(SEND[type])});
            else {
                gl.uniform1iv(location, Array(size).fill(samplers.length));
                samplers.push({input: inputs[pass.samplers?.[name]]});
            }
        }
        gl.deleteShader(shader);  // as soon as its program is
    };

    // Makes the texture of what is no buffer.
    const fill = async input => {
        const {source, target, formats, type, size, mipmaps, data} = input;
        const bytes = data && await new Response((await fetch(data)).body.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
        input.textures = [makeTexture(gl, input, formatOf("a picture", formats), size)];
        if (source === "keyboard") input.rowsAt = frame => frame.keys;
        if (source === "sound") input.rowsAt = rowsOf(new Uint8Array(bytes), input);
        if (source === "noise") upload(input, noiseBytes(input));
        if (source === "pixels") upload(input, new (type === gl.FLOAT ? Float32Array : Uint8Array)(bytes));
        if (mipmaps) gl.generateMipmap(target);
    };

    const upload = ({target, image, textures, size: [w, h, depth], faces, layout, type}, texels) => {
        gl.bindTexture(target, textures[0]);
        if (target === gl.TEXTURE_3D) gl.texSubImage3D(target, 0, 0, 0, 0, w, h, depth, layout, type, texels);
        else for (let face = 0; face < faces; ++face)
            gl.texSubImage2D(image + face, 0, 0, 0, w, h, layout, type, texels.subarray(texels.length / faces * face));
    };

    // From the next frame on these are drawn.
    const use = linked => {
        for (const pass of passes) {
            gl.deleteProgram(pass.program?.id);
            Object.assign(pass, {program: linked.get(pass), drawn: false, state: false});
        }
        const live = player.live = passes.filter(pass => pass.program), reads = pass => pass.program.samplers.map(({input}) => input?.from);
        // What a pass reads that is drawn with it or behind it is of the frame before: later frames depend on that, and on all it reads.
        const keep = pass => {
            if (!pass || pass.state) return;
            pass.state = true;
            reads(pass).forEach(keep);
        };
        live.forEach((reader, i) => reader.step ? keep(reader) : reads(reader).forEach(pass => live.indexOf(pass) < i || keep(pass)));
        shape();
    };

    // A buffer of another size begins anew: what carries anything on has the size that it began with.
    const shape = () => {
        for (const pass of player.live) {
            const pixels = pixelsOf(pass);
            if (`${pixels}` !== `${pass.pixels}`) free(pass);
            pass.pixels = pixels;
            if (pass.formats) pass.buffer ??= makeBuffer(gl, pass, formatOf(pass.name, pass.formats), pixels);
        }
    };
    const free = pass => {
        pass.buffer?.free();
        pass.buffer = null;
        pass.drawn = false;
    };

    // What is new in what no pass draws.
    const instant = frame => {
        for (const input of inputs) {
            const rows = input.rowsAt?.(frame), text = `${rows}`;
            if (input.rows === text) continue;
            input.rows = text;
            ++input.version;
            if (rows) upload(input, rows);
        }
    };

    const drawPass = (pass, frame, force) => {
        const {program, buffer, pixels, channels} = pass, iResolution = [...pixels, 1], told = {
            __proto__: null, ...frame, iResolution, u_resolution: iResolution, uResolution: iResolution, resolution: iResolution,
            ...channels && channelsTold(channels.map(i => inputs[i]), frame.iTime, sizeOf),
        };
        plan.tweaks.forEach(({name}, i) => told[name] = player.values[i]);
        gl.useProgram(program.id);
        let isDue = force || !pass.drawn, face;
        for (const uniform of program.uniforms) {
            // A text may ask for fewer of the numbers, by another type.
            const {name, location, send, sent, count} = uniform, value = [told[name] ?? []].flat().slice(0, count);
            if (name === "glint_face") face = location;
            uniform.sent = `${value}`;
            if (sent === uniform.sent || !value.length) continue;
            gl[send](location, value);
            isDue = true;
        }
        for (const sampler of program.samplers) {
            const {input, version} = sampler;
            sampler.read = input?.from?.buffer ?? input;
            sampler.version = sampler.read?.version;
            isDue ||= version !== sampler.version;
        }
        if (!isDue) return;
        pass.drawn = true;
        isNew ||= pass === root;
        program.samplers.forEach(({input, read}, unit) => {
            if (!input) return;
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(input.target, read.textures[input.output]);
            gl.bindSampler(unit, input.sampler);
        });
        gl.viewport(0, 0, ...pixels);
        for (let i = 0; i < pass.faces; ++i) {
            gl.uniform1i(face, i);
            gl.bindFramebuffer(gl.FRAMEBUFFER, buffer?.frames[i]);
            gl.drawArrays(gl.TRIANGLES, 0, 3);
        }
        gl.activeTexture(gl.TEXTURE0);
        buffer?.finish();
    };

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
        // The picture as it stands, of which a browser keeps no copy.
        again() { drawPass(root, last, true); },
        // Draws whatever has changed, or only what later frames depend on. True when the picture is new.
        draw(frame, onlyState) {
            instant(last = frame);
            isNew = false;
            const stepped = {};
            for (const pass of player.live) {
                const {step} = pass;
                if (onlyState && !pass.state || stepped[step]) continue;
                if (stepped[step] = step) (drawSteps ??= makeSteps(player, instant, drawPass))(step, frame);
                else drawPass(pass, frame);
            }
            return isNew;
        },
        // Until the GPU is done.
        async wait() {
            const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
            while (gl.clientWaitSync(fence, gl.SYNC_FLUSH_COMMANDS_BIT, 0) === gl.TIMEOUT_EXPIRED) await pause();
        },
    };
    return player;
};

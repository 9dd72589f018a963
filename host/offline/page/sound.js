// mainSound, made block by block just before it is heard. In a page alone that has it.
import {makePlayer} from "./player.js";
import {dateAfter, frameAt} from "./clock.js";
import {floor, list, max} from "./arithmetic.js";

const RATE = 44100;

// A context of WebGL of its own: 32-bit floats that are read back.
export const makeSound = plan => {
    const gl = document.createElement("canvas").getContext("webgl2"), player = makePlayer(gl, plan, plan.sound);
    const [w, h] = player.root.size, samples = w * h, blockSeconds = samples / RATE;
    player.size = plan.size;
    let context, timer;
    const sound = {
        async load(values) {
            player.values = values;
            player.use(await player.link(values));
            return sound;
        },
        // Left and right, 8192 samples each.
        block(index) {
            const rgba = new Float32Array(samples * 4);
            player.draw({...frameAt(plan, index * blockSeconds, 1 / 60, index), iDate: dateAfter(plan, 0)});
            gl.bindFramebuffer(gl.FRAMEBUFFER, player.root.buffer.frames[0]);
            gl.readPixels(0, 0, w, h, gl.RGBA, gl.FLOAT, rgba);
            return [0, 1].map(side => new Float32Array(list(samples, i => rgba[i * 4 + side] || 0)));
        },
        // After a click; heard from this time of the scene on.
        play(time) {
            sound.stop();
            context = new AudioContext({sampleRate: RATE});
            const start = context.currentTime - time;
            let next = 0;
            timer = setInterval(() => {
                // One at a time, twice as fast as they are heard; of what is slower to make the rest has gaps.
                next = max(next, floor((context.currentTime - start) / blockSeconds));
                const at = start + next * blockSeconds;
                if (at > context.currentTime + 0.6) return;
                const source = context.createBufferSource();
                source.buffer = context.createBuffer(2, samples, RATE);
                sound.block(next++).forEach((heard, side) => source.buffer.copyToChannel(heard, side));
                source.connect(context.destination);
                source.start(max(at, 0), max(context.currentTime - at, 0));
            }, 100);
        },
        stop() {
            clearInterval(timer);
            context?.close();
            context = null;
        },
    };
    return sound;
};

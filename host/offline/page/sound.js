// mainSound, made block by block just before it is heard. In a page alone that has it.
import {makePlayer} from "./player.js";
import {frameAt} from "./clock.js";

const WIDTH = 512, ROWS = 16, RATE = 44100, SAMPLES = WIDTH * ROWS, SECONDS = SAMPLES / RATE;

// A context of WebGL of its own: 32-bit floats that are read back.
export function makeSound(plan) {
    const gl = document.createElement("canvas").getContext("webgl2"), size = [WIDTH, ROWS];
    const player = makePlayer(gl, plan, plan.sound.with(-1, {...plan.sound.at(-1), format: "rgba32f", size}));
    let context, gain, timer;
    player.size = size;
    const sound = {
        async load(values) {
            player.values = values;
            player.use(await player.link(values));
        },
        // Left and right, 8192 samples each.
        block(index) {
            const rgba = new Float32Array(SAMPLES * 4), {iDate} = frameAt(plan, 0, 1, 0);
            player.draw({...frameAt(plan, index * SECONDS, 1 / 60, index), iDate, iMouse: [0, 0, 0, 0], u_mouse: [0, 0]});
            gl.bindFramebuffer(gl.FRAMEBUFFER, player.root.buffer.target(0));
            gl.readPixels(0, 0, ...size, gl.RGBA, gl.FLOAT, rgba);
            return [0, 1].map(side => Float32Array.from({length: SAMPLES}, (_, i) => rgba[i * 4 + side] || 0));
        },
        // After a click; heard from this time of the scene on.
        play(time) {
            sound.stop();
            context ??= new AudioContext({sampleRate: RATE});
            context.resume();
            gain = context.createGain();
            gain.connect(context.destination);
            const start = context.currentTime + 0.05 - time;
            let next = Math.floor(time / SECONDS);
            timer = setInterval(() => {
                for (; start + next * SECONDS < context.currentTime + 0.6; ++next) {
                    const buffer = context.createBuffer(2, SAMPLES, RATE), source = context.createBufferSource(), at = start + next * SECONDS;
                    sound.block(next).forEach((samples, side) => buffer.copyToChannel(samples, side));
                    source.buffer = buffer;
                    source.connect(gain);
                    source.start(Math.max(at, 0), Math.max(context.currentTime - at, 0));
                }
            }, 100);
        },
        stop() { clearInterval(timer); gain?.disconnect(); },
    };
    return sound;
}

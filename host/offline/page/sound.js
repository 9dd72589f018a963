// mainSound, made block by block just before it is heard.
import {Player} from "./player.js";
import {frameAt} from "./clock.js";

const WIDTH = 512, ROWS = 16, RATE = 44100, SAMPLES = WIDTH * ROWS;

// A context of WebGL of its own: 32-bit floats that are read back.
export class Sound {
    constructor(plan) {
        const gl = document.createElement("canvas").getContext("webgl2");
        const passes = plan.sound.with(-1, {...plan.sound.at(-1), format: "rgba32f", size: [WIDTH, ROWS]});
        this.plan = plan;
        this.player = new Player(gl, plan, passes);
    }
    async load(values) {
        this.player.values = values;
        this.player.use(await this.player.link(values));
        this.player.size = [WIDTH, ROWS];
    }
    // Left and right, 8192 samples each.
    block(index) {
        const {player} = this, {gl, root} = player, rgba = new Float32Array(SAMPLES * 4);
        player.draw({...frameAt(this.plan, index * SAMPLES / RATE, 1 / 60, index), date: frameAt(this.plan, 0, 1, 0).date, mouse: [0, 0, 0, 0]});
        gl.bindFramebuffer(gl.FRAMEBUFFER, root.buffer.sides[root.buffer.front].frames[0]);
        gl.readPixels(0, 0, WIDTH, ROWS, gl.RGBA, gl.FLOAT, rgba);
        return [0, 1].map(side => Float32Array.from({length: SAMPLES}, (_, i) => rgba[i * 4 + side] || 0));
    }
    // After a click; heard from this time of the scene on.
    play(time) {
        this.stop();
        const context = this.context ??= new AudioContext({sampleRate: RATE});
        context.resume();
        this.gain = context.createGain();
        this.gain.connect(context.destination);
        const start = context.currentTime + 0.05 - time;
        let next = Math.floor(time * RATE / SAMPLES);
        this.timer = setInterval(() => {
            for (; start + next * SAMPLES / RATE < context.currentTime + 0.6; ++next) {
                const buffer = context.createBuffer(2, SAMPLES, RATE), source = context.createBufferSource();
                this.block(next).forEach((samples, side) => buffer.copyToChannel(samples, side));
                source.buffer = buffer;
                source.connect(this.gain);
                const late = context.currentTime - start - next * SAMPLES / RATE;
                source.start(Math.max(start + next * SAMPLES / RATE, 0), Math.max(late, 0));
            }
        }, 100);
    }
    stop() { clearInterval(this.timer); this.gain?.disconnect(); }
}

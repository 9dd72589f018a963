// A sound as shaders see it. In a page alone that reads one.

const SIZE = 2048, BINS = 512, BLOCK = 735, REMEMBERED = 64;  // samples of 44.1 kHz; blocks of 1/60 s

// Magnitudes of the lower bins: a Fourier transform of a power of two, in place.
export function spectrum(values) {
    const re = Float64Array.from(values), im = new Float64Array(SIZE);
    for (let i = 1, j = 0; i < SIZE; ++i) {
        for (let bit = SIZE >> 1; (j ^= bit) < bit; bit >>= 1);
        if (i < j) [re[i], re[j]] = [re[j], re[i]];
    }
    for (let half = 1; half < SIZE; half *= 2)
        for (let k = 0; k < half; ++k) {
            const c = Math.cos(Math.PI * k / half), s = -Math.sin(Math.PI * k / half);
            for (let i = k, j = k + half; i < SIZE; i += 2 * half, j += 2 * half) {
                const x = re[j] * c - im[j] * s, y = re[j] * s + im[j] * c;
                re[j] = re[i] - x; im[j] = im[i] - y; re[i] += x; im[i] += y;
            }
        }
    return Float64Array.from({length: BINS}, (_, i) => Math.hypot(re[i], im[i]) / SIZE);
}

const byte = v => Math.min(Math.max(Math.floor(v), 0), 255);

// A sound as shaders see it: 512 bytes of spectrum, 512 of the wave, as an AnalyserNode smooths at 60 Hz.
export class Analyser {
    constructor(samples) { this.samples = samples; this.known = new Map(); this.block = -1; }
    mono(i) {
        if (i < 0) return 0;
        const at = i * 2 % this.samples.length;
        return (this.samples[at] + this.samples[at + 1]) / 65536;
    }
    magnitudes(block) {
        if (!this.known.has(block)) {
            const window = i => 0.42 - 0.5 * Math.cos(2 * Math.PI * i / SIZE) + 0.08 * Math.cos(4 * Math.PI * i / SIZE);
            const heard = Array.from({length: SIZE}, (_, i) => window(i) * this.mono(block * BLOCK - SIZE + i));
            this.known.set(block, spectrum(heard));
            this.known.delete(block - REMEMBERED);
        }
        return this.known.get(block);
    }
    // The same array as before while nothing is new.
    rowsAt(time) {
        const block = Math.floor(Math.max(time, 0) * 60 + 1e-6);
        if (block === this.block) return this.rows;
        const smooth = new Float64Array(BINS), rows = new Uint8Array(2 * BINS);
        for (let k = Math.max(block - REMEMBERED + 1, 0); k <= block; ++k)
            this.magnitudes(k).forEach((m, i) => smooth[i] = 0.8 * smooth[i] + 0.2 * m);
        for (let i = 0; i < BINS; ++i) {
            rows[i] = byte(255 / 70 * (20 * Math.log10(smooth[i]) + 100));
            rows[BINS + i] = byte(128 * (1 + this.mono(block * BLOCK - SIZE + i)));
        }
        this.block = block;
        return this.rows = rows;
    }
}

// A sound as shaders see it: 512 bytes of spectrum, 512 of the wave, as an AnalyserNode smooths at 60 Hz. In a page
// alone that reads one.

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
    return re.slice(0, BINS).map((x, i) => Math.hypot(x, im[i]) / SIZE);
}

// Gives the rows of a time: the same array as before while nothing is new.
export function makeAnalyser(samples) {
    const known = new Map();
    let rows, seen;
    const mono = i => i < 0 ? 0 : (samples[i * 2 % samples.length] + samples[i * 2 % samples.length + 1]) / 65536;
    function magnitudes(block) {
        if (!known.has(block)) {
            const window = i => 0.42 - 0.5 * Math.cos(2 * Math.PI * i / SIZE) + 0.08 * Math.cos(4 * Math.PI * i / SIZE);
            known.set(block, spectrum(Array.from({length: SIZE}, (_, i) => window(i) * mono(block * BLOCK - SIZE + i))));
            known.delete(block - REMEMBERED);
        }
        return known.get(block);
    }
    return time => {
        const block = Math.floor(Math.max(time, 0) * 60 + 1e-6);
        if (block === seen) return rows;
        seen = block;
        const smooth = new Float64Array(BINS);
        for (let k = Math.max(block - REMEMBERED + 1, 0); k <= block; ++k)
            magnitudes(k).forEach((m, i) => smooth[i] = 0.8 * smooth[i] + 0.2 * m);
        const wave = smooth.map((_, i) => 128 * (1 + mono(block * BLOCK - SIZE + i)));
        // Where these are stored, a number goes to the next byte below, and 0 and 255 are the ends.
        return rows = Uint8ClampedArray.from([...smooth.map(m => 255 / 70 * (20 * Math.log10(m) + 100)), ...wave], Math.floor);
    };
}

// Uniform random bytes, the host's (pcg3d, Jarzynski and Olano 2020). In a page alone that reads some.

export function noiseBytes({size: [w, h, depth], faces, channels}) {
    const count = w * h * depth * faces, bytes = new Uint8Array(count * channels), step = n => Math.imul(n, 1664525) + 1013904223 | 0;
    for (let i = 0; i < count; ++i) {
        let [x, y, z] = [i % w, Math.floor(i / w) % h, Math.floor(i / w / h)].map(step);
        const mix = () => {
            x = x + Math.imul(y, z) | 0;
            y = y + Math.imul(z, x) | 0;
            z = z + Math.imul(x, y) | 0;
        };
        mix();
        x ^= x >>> 16; y ^= y >>> 16; z ^= z >>> 16;
        mix();
        bytes.set([x >>> 24, y >>> 24, z >>> 24, (x ^ y ^ z) >>> 12].slice(0, channels), i * channels);
    }
    return bytes;
}

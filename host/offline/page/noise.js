// Uniform random bytes, the host's (pcg3d, Jarzynski and Olano 2020). In a page alone that reads some.
import {floor, imul} from "./arithmetic.js";

export const noiseBytes = ({size: [w, h, depth], faces, channels}) => {
    const count = w * h * depth * faces, bytes = new Uint8Array(count * channels);
    for (let i = 0; i < count; ++i) {
        let [x, y, z] = [i % w, floor(i / w) % h, floor(i / w / h)].map(n => imul(n, 1664525) + 1013904223 | 0);
        const mix = () => {
            x = x + imul(y, z) | 0;
            y = y + imul(z, x) | 0;
            z = z + imul(x, y) | 0;
        };
        mix();
        x ^= x >>> 16; y ^= y >>> 16; z ^= z >>> 16;
        mix();
        bytes.set([x >>> 24, y >>> 24, z >>> 24, (x ^ y ^ z) >>> 12].slice(0, channels), i * channels);
    }
    return bytes;
};

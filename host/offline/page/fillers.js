// What samplers read besides buffers: bytes of files, noise, sounds.

// A data: address of deflated bytes.
export async function inflate(address) {
    const stream = (await fetch(address)).body.pipeThrough(new DecompressionStream("deflate"));
    return new Response(stream).arrayBuffer();
}

// Uniform random bytes, the host's (pcg3d, Jarzynski and Olano 2020).
export function noiseBytes([w, h, depth], channels) {
    const bytes = new Uint8Array(w * h * depth * channels), step = n => Math.imul(n, 1664525) + 1013904223 | 0;
    for (let i = 0, at = 0; i < w * h * depth; ++i) {
        let x = step(i % w), y = step(Math.floor(i / w) % h), z = step(Math.floor(i / w / h));
        for (let round = 0; round < 2; ++round) {
            x = x + Math.imul(y, z) | 0; y = y + Math.imul(z, x) | 0; z = z + Math.imul(x, y) | 0;
            if (!round) { x ^= x >>> 16; y ^= y >>> 16; z ^= z >>> 16; }
        }
        const parts = [x >>> 24, y >>> 24, z >>> 24, (x ^ y ^ z) >>> 12];
        for (let c = 0; c < channels; ++c) bytes[at++] = parts[c];
    }
    return bytes;
}

// What a pass fills: its textures, two sides of them where it reads itself back, and the way to draw into them.
import {list, max} from "./arithmetic.js";

// Of a shape that the host wrote: what WebGL calls the kind of texture.
export const makeTexture = (gl, {target, mipmaps}, format, [w, h, depth = 1]) => {
    const texture = gl.createTexture(), shape = [target, mipmaps ? 32 - Math.clz32(max(w, h, depth)) : 1, gl[format], w, h];
    gl.bindTexture(target, texture);
    if (target === gl.TEXTURE_3D) gl.texStorage3D(...shape, depth);
    else gl.texStorage2D(...shape);
    return texture;
};

let versions = 0;  // of all buffers: no two pictures have the same

export const makeBuffer = (gl, shape, format, size) => {
    const {target, image, faces, outputs, mipmaps} = shape;
    // Readers see the first side, the last one is drawn into.
    const sides = list(shape.sides, () => {
        const textures = list(outputs, () => makeTexture(gl, shape, format, size)), points = textures.map((_, i) => gl.COLOR_ATTACHMENT0 + i);
        const frames = list(faces, face => {
            const frame = gl.createFramebuffer();
            gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
            textures.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, points[i], image + face, texture, 0));
            gl.drawBuffers(points);
            return frame;
        });
        return {textures, frames};
    });
    return {
        version: ++versions,
        get textures() { return sides[0].textures; },
        get frames() { return sides.at(-1).frames; },
        // What was drawn becomes what readers see.
        finish() {
            sides.reverse();
            this.version = ++versions;
            if (mipmaps) for (const texture of this.textures) {
                gl.bindTexture(target, texture);
                gl.generateMipmap(target);
            }
        },
        free() {
            for (const {textures, frames} of sides) {
                textures.forEach(texture => gl.deleteTexture(texture));
                frames.forEach(frame => gl.deleteFramebuffer(frame));
            }
        },
    };
};

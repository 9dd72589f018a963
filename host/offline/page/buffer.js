// What a pass fills: its textures, double where it reads itself back, and the way to draw into them.

export function makeTexture(gl, kind, format, [w, h, depth = 1], mipmaps) {
    const target = gl["TEXTURE_" + kind], texture = gl.createTexture();
    const levels = mipmaps ? Math.floor(Math.log2(Math.max(w, h, kind === "3D" ? depth : 1))) + 1 : 1;
    gl.bindTexture(target, texture);
    if (kind === "3D") gl.texStorage3D(target, levels, gl[format], w, h, depth);
    else gl.texStorage2D(target, levels, gl[format], w, h);
    return texture;
}

// shape: {format, size, outputs, cube, double, mipmaps}
export class Buffer {
    constructor(gl, shape) {
        this.gl = gl;
        this.shape = shape;
        this.kind = shape.cube ? "CUBE_MAP" : "2D";
        this.version = this.front = 0;
        this.sides = Array.from({length: shape.double ? 2 : 1}, () => this.makeSide());
    }
    makeSide() {
        const {gl, shape} = this;
        const textures = Array.from({length: shape.outputs ?? 1},
            () => makeTexture(gl, this.kind, shape.format.toUpperCase(), shape.size, shape.mipmaps));
        const frames = Array.from({length: shape.cube ? 6 : 1}, (_, face) => {
            const frame = gl.createFramebuffer(), points = textures.map((_, i) => gl.COLOR_ATTACHMENT0 + i);
            gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
            textures.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, points[i],
                shape.cube ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : gl.TEXTURE_2D, texture, 0));
            gl.drawBuffers(points);
            return frame;
        });
        return {textures, frames};
    }
    texture(output) { return this.sides[this.front].textures[output]; }
    target(face) { return this.sides[(this.front + 1) % this.sides.length].frames[face]; }

    // What was drawn into the target becomes what readers see.
    finish() {
        const {gl} = this;
        this.front = (this.front + 1) % this.sides.length;
        ++this.version;
        for (const texture of this.shape.mipmaps ? this.sides[this.front].textures : []) {
            gl.bindTexture(gl["TEXTURE_" + this.kind], texture);
            gl.generateMipmap(gl["TEXTURE_" + this.kind]);
        }
    }
    // The content stays, pixel for pixel from the bottom left.
    resize(size) {
        const {gl} = this, old = this.sides, [w, h] = size.map((s, i) => Math.min(s, this.shape.size[i]));
        this.shape = {...this.shape, size};
        this.sides = old.map(() => this.makeSide());
        old.forEach((side, i) => this.sides[i].textures.forEach((texture, output) => {
            gl.bindFramebuffer(gl.FRAMEBUFFER, side.frames[0]);
            gl.readBuffer(gl.COLOR_ATTACHMENT0 + output);
            gl.bindTexture(gl.TEXTURE_2D, texture);
            gl.copyTexSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 0, 0, w, h);
        }));
        old.forEach(side => this.freeSide(side));
        ++this.version;
    }
    freeSide({textures, frames}) {
        textures.forEach(texture => this.gl.deleteTexture(texture));
        frames.forEach(frame => this.gl.deleteFramebuffer(frame));
    }
    free() { this.sides.forEach(side => this.freeSide(side)); }
}

// What a pass fills: its textures, double where it reads itself back, and the way to draw into them.

export function makeTexture(gl, kind, format, [w, h, depth = 1], mipmaps) {
    const target = gl["TEXTURE_" + kind], texture = gl.createTexture(), shape = [gl[format.toUpperCase()], w, h];
    const levels = mipmaps ? 1 + Math.floor(Math.log2(Math.max(w, h, depth))) : 1;
    gl.bindTexture(target, texture);
    if (kind === "3D") gl.texStorage3D(target, levels, ...shape, depth);
    else gl.texStorage2D(target, levels, ...shape);
    return texture;
}

let versions = 0;  // of all buffers: no two pictures have the same

export function makeBuffer(gl, {format, size, outputs = 1, cube, double, mipmaps}) {
    const kind = cube ? "CUBE_MAP" : "2D";
    const sides = Array.from({length: double ? 2 : 1}, () => {
        const textures = Array.from({length: outputs}, () => makeTexture(gl, kind, format, size, mipmaps));
        const frames = Array.from({length: cube ? 6 : 1}, (_, face) => {
            const frame = gl.createFramebuffer(), points = textures.map((_, i) => gl.COLOR_ATTACHMENT0 + i);
            gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
            textures.forEach((texture, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, points[i],
                cube ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : gl.TEXTURE_2D, texture, 0));
            gl.drawBuffers(points);
            return frame;
        });
        return {textures, frames};
    });
    let [front] = sides;
    const back = () => sides.at(sides.indexOf(front) - 1);
    const buffer = {
        version: ++versions,
        texture: output => front.textures[output],
        target: face => back().frames[face],
        // What was drawn into the target becomes what readers see.
        finish() {
            front = back();
            buffer.version = ++versions;
            for (const texture of mipmaps ? front.textures : []) {
                gl.bindTexture(gl["TEXTURE_" + kind], texture);
                gl.generateMipmap(gl["TEXTURE_" + kind]);
            }
        },
        free: () => sides.forEach(({textures, frames}) => {
            textures.forEach(texture => gl.deleteTexture(texture));
            frames.forEach(frame => gl.deleteFramebuffer(frame));
        }),
    };
    return buffer;
}

// Mouse and keys by the site's rules.

const pixel = (fraction, pixels) => Math.floor(fraction * pixels + 1e-6);

// Follows events, and gives the input of each frame. Rows of keys: held, pressed in this frame, toggled.
export class InputState {
    keys = new Uint8Array(768);
    position = [0, 0];
    click = null;
    down = false;
    pressed = false;

    apply({key, mouse, down}) {
        if (key !== undefined) {
            if (down && !this.keys[key]) { this.keys[256 + key] = 255; this.keys[512 + key] ^= 255; }
            this.keys[key] = down ? 255 : 0;
            return;
        }
        if (down) {
            this.position = mouse;
            if (!this.down) { this.click = mouse; this.pressed = true; }
        }
        this.down = down;
    }

    // Ends the frame: what was pressed is no longer new afterwards.
    next([w, h]) {
        const keys = this.keys.slice();
        let mouse = [0, 0, 0, 0];
        if (this.click) {
            const x = pixel(this.click[0], w), y = pixel(this.click[1], h);
            mouse = [pixel(this.position[0], w), pixel(this.position[1], h), this.down ? x : -x, this.pressed ? y : -y];
        }
        this.pressed = false;
        this.keys.fill(0, 256, 512);
        return {mouse, keys};
    }
}

// What was done, in order of time: the preset's events and those of whoever looks.
export class Tape {
    constructor(events) { this.events = [...events]; }
    add(event) {
        let at = this.events.length;
        while (at > 0 && this.events[at - 1].t > event.t) --at;
        this.events.splice(at, 0, event);
    }
    reader() { return new TapeReader(this); }
}

class TapeReader {
    constructor(tape) { this.tape = tape; this.at = 0; this.state = new InputState(); }
    // The input at a time; what happened since the last call counts as new, unless it is before `from`.
    input(to, size, from = -Infinity) {
        this.until(Math.min(from, to));
        if (this.tape.events[this.at - 1]?.t <= from) this.state.next(size);
        this.until(to);
        return this.state.next(size);
    }
    until(time) {
        const {events} = this.tape;
        while (this.at < events.length && events[this.at].t <= time) this.state.apply(events[this.at++]);
    }
}

// Mouse and keys by the site's rules.
import {floor, min} from "./arithmetic.js";

const pixel = (fraction, pixels) => floor(fraction * pixels + 1e-6);

// Follows events, and gives the input of each frame. Rows of keys: held, pressed in this frame, toggled.
export const makeInput = () => {
    const keys = new Uint8Array(768);
    let at = [0, 0], click = at, held, isPressed;
    return {
        apply({key, mouse, down}) {
            if (key) {
                if (down && !keys[key]) { keys[256 + key] = 255; keys[512 + key] ^= 255; }
                keys[key] = down ? 255 : 0;
            } else if (mouse) {
                if (down) {
                    at = mouse;
                    if (!held) { click = mouse; isPressed = true; }
                }
                held = down;
            } else keys.fill(0, 0, 256);  // whoever held them has gone
        },
        // Ends the frame: what was pressed is no longer new afterwards.
        next([w, h]) {
            const seen = keys.slice(), [x, y, clickX, clickY] = [at, click].flatMap(([x, y]) => [pixel(x, w), pixel(y, h)]);
            const iMouse = [x, y, held ? clickX : 0 - clickX, isPressed ? clickY : 0 - clickY];
            isPressed = false;
            keys.fill(0, 256, 512);
            return {iMouse, u_mouse: [x, y], mouse: [x / w, y / h], keys: seen};
        },
    };
};

// What was done, in order of time: the preset's events and those of whoever looks.
export const makeTape = events => ({
    events,
    add(event) {
        events.push(event);
        events.sort((a, b) => a.t - b.t);
    },
    // The input at a time; what happened since the last call counts as new, unless it is before `from`.
    reader() {
        const state = makeInput();
        let at = 0;
        const until = time => { while (events[at]?.t <= time) state.apply(events[at++]); };
        return {
            input(to, size, from = -Infinity) {
                until(min(from, to));
                if (events[at - 1]?.t <= from) state.next(size);
                until(to);
                return state.next(size);
            },
        };
    },
});

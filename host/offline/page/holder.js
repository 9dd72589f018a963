// The picture's resolution, held by itself: fewer pixels where frames take long, more where there is time.
import {max} from "./arithmetic.js";

const SLOW = 1000 / 22, QUICK = 1000 / 40, LEAST = 0.2;

export const makeHolder = () => {
    let isHeld = true, most = 1, times = [];
    return {
        share: 1,
        // "auto", or the share of the screen's pixels a side.
        hold(text) {
            isHeld = !+text;
            this.share = +text || 1;
            most = 1;
            times = [];
        },
        // A frame, so long after the one before; 0 after a pause. A few tell what all do where they take long; one tells nothing.
        took(ms) {
            const before = this.share;
            if (isHeld && ms) times.push(ms);
            if (!times[ms > 200 ? 2 : 11]) return;
            const median = times.sort((a, b) => a - b)[times.length >> 1];
            times = [];
            if (median > SLOW) {
                most = before;  // more was too much
                this.share = max(LEAST, before * max(0.5, (33 / median) ** 0.5));
            } else if (median < QUICK && before * 1.2 < most) this.share *= 1.2;
        },
    };
};

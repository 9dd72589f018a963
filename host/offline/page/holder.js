// The picture's resolution, held by itself: fewer pixels where frames take long, more where there is time.
import {max} from "./arithmetic.js";

const SLOW = 1000 / 22, QUICK = 1000 / 40, LEAST = 0.2;

export const makeHolder = () => {
    let isHeld = true, last, most = 1, times = [];
    return {
        share: 1,
        // "auto", or the share of the screen's pixels a side.
        hold(text) {
            isHeld = !+text;
            this.share = +text || 1;
            most = 1;
            times = [];
        },
        // A frame at `now` (ms).
        took(now) {
            const ms = now - last, before = this.share;
            last = now;
            if (isHeld && ms < 2000) times.push(ms);
            if (times.length < 12 && !(times.reduce((a, b) => a + b, 0) > 600)) return;
            const median = times.sort((a, b) => a - b)[times.length >> 1];
            times = [];
            if (median > SLOW) {
                most = before;  // more was too much
                this.share = max(LEAST, before * max(0.5, Math.sqrt(33 / median)));
            } else if (median < QUICK && before * 1.2 < most) this.share *= 1.2;
        },
    };
};

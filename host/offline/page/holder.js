// The picture's resolution, held by itself: fewer pixels where frames take long, more where there is time.

const SLOW = 1000 / 22, QUICK = 1000 / 40, LEAST = 0.2;

export class Holder {
    constructor() { this.share = 1; this.auto = true; this.last = null; this.times = []; this.most = 1; }
    // "auto", or the share of the screen's pixels a side.
    hold(text) {
        this.auto = text === "auto";
        this.share = this.auto ? 1 : +text;
        this.most = 1;
        this.times = [];
    }
    // A frame at `now` (ms); true where the share has changed.
    took(now) {
        const ms = this.last === null ? 0 : now - this.last;
        this.last = now;
        if (!this.auto || ms <= 0 || ms > 2000) return false;
        this.times.push(ms);
        if (this.times.length < 12 && this.times.reduce((a, b) => a + b) < 600) return false;
        const median = this.times.sort((a, b) => a - b)[this.times.length >> 1], before = this.share;
        this.times = [];
        if (median > SLOW) {
            this.most = before;  // more was too much
            this.share = Math.max(LEAST, before * Math.max(0.5, Math.sqrt(33 / median)));
        } else if (median < QUICK && before * 1.2 < this.most) this.share = before * 1.2;
        return this.share !== before;
    }
}

// Time: which frames stand where, and what of it a shader is told. The same numbers as the host's.

export const FPS = 60;

// Frame k stands at k / FPS, the last one at `end`. The tolerance forgives times such as 7/60.
export const lastFrame = end => Math.min(Math.max(Math.ceil(end * FPS - 1e-6), 0), 2e9);

// Time in 1/65536 s, modulo 2^32.
export const tick = time => Math.floor(time % 65536 * 65536) >>> 0;

// Whole steps of n/d seconds that have elapsed.
export const stepsDue = (time, [n, d]) => Math.floor(time * d / n + 1e-6);

// iDate: year, month from 0, day, seconds since midnight.
export function dateAfter([year, month, day, seconds], elapsed) {
    const sum = seconds + elapsed, days = Math.floor(sum / 86400);
    const date = new Date(Date.UTC(2000, month - 1, day + days));
    date.setUTCFullYear(date.getUTCFullYear() + year - 2000);
    const latest = 86400 - 1 / 128;  // the float below midnight
    return [date.getUTCFullYear(), date.getUTCMonth(), date.getUTCDate(), Math.min(sum - days * 86400, latest)];
}

export function frameAt(plan, time, delta, frame) {
    return {time, delta, rate: 1 / delta, frame, date: dateAfter(plan.date, time)};
}

// Frame k of a playback that ends at `end`; beyond its last one time stands still. What was done after `from` is new.
export function playedFrame(plan, k, end) {
    const last = lastFrame(end), at = i => i >= last ? end : i / FPS, from = k ? at(k - 1) : -Infinity;
    return {...frameAt(plan, at(k), k === 0 || k > last ? 1 / 60 : at(k) - from, k), from};
}

// Time that runs while it plays, by the clock of the browser; after a hitch it goes on where it stood.
export class Clock {
    constructor(time) { this.time = time; this.playing = true; this.last = null; }
    // `now` in milliseconds; returns the seconds that passed, or 0.
    advance(now) {
        const passed = this.last === null || !this.playing ? 0 : Math.min((now - this.last) / 1000, 1);
        this.last = this.playing ? now : null;
        this.time += passed;
        return passed;
    }
}

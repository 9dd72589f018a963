// Time: which frames stand where, and what of it a shader is told. The same numbers as the host's.

export const FPS = 60;

// Frame k stands at k / FPS, the last one at `end`. The tolerance forgives times such as 7/60.
export const lastFrame = end => Math.min(Math.max(Math.ceil(end * FPS - 1e-6), 0), 2e9);

// Whole steps of n/d seconds that have elapsed.
export const stepsDue = (time, [n, d]) => Math.floor(time * d / n + 1e-6);

// iDate: year, month from 0, day, seconds since midnight. `day` is counted from 1970 on.
export function dateAfter({day, seconds}, elapsed) {
    const sum = seconds + elapsed, date = new Date((day + Math.floor(sum / 86400)) * 864e5);
    const latest = 86400 - 1 / 128;  // the float below midnight
    return [date.getUTCFullYear(), date.getUTCMonth(), date.getUTCDate(), Math.min(sum % 86400, latest)];
}

// The uniforms that tell the time. iTick counts 1/65536 s, modulo 2^32.
export const timed = (time, delta, frame) => ({
    iTime: time, iGlobalTime: time, u_time: time, iTimeDelta: delta, iFrameRate: 1 / delta, iFrame: frame,
    iTick: Math.floor(time % 65536 * 65536) >>> 0,
});

export const frameAt = (plan, time, delta, frame) => ({...timed(time, delta, frame), iSampleRate: 44100, iDate: dateAfter(plan, time)});

// Frame k of a playback that ends at `end`; beyond its last one time stands still. What was done after `from` is new.
export function playedFrame(plan, k, end) {
    const last = lastFrame(end), at = i => i >= last ? end : i / FPS, from = k ? at(k - 1) : -Infinity;
    return {...frameAt(plan, at(k), k === 0 || k > last ? 1 / 60 : at(k) - from, k), from};
}

// Time that runs while it plays, by the clock of the browser; after a hitch it goes on where it stood.
export class Clock {
    playing = true;
    last = null;
    constructor(time) { this.time = time; }
    // `now` in milliseconds; returns the seconds that passed, or 0.
    advance(now) {
        const passed = this.last === null || !this.playing ? 0 : Math.min((now - this.last) / 1000, 1);
        this.last = this.playing ? now : null;
        this.time += passed;
        return passed;
    }
}

// Time: which frames stand where, and what of it a shader is told. The same numbers as the host's.
import {ceil, clamp, floor, min} from "./arithmetic.js";

export const FPS = 60;

// Frame k stands at k / FPS, the last one at `end`. The tolerance forgives times such as 7/60.
export const lastFrame = end => clamp(ceil(end * FPS - 1e-6), 0, 2e9);

// iDate: year, month from 0, day, seconds since midnight. `day` is counted from 1970 on.
export const dateAfter = ({day, seconds}, elapsed) => {
    const sum = seconds + elapsed, date = new Date((day + floor(sum / 86400)) * 864e5);
    const latest = 86400 - 1 / 128;  // the float below midnight
    return [date.getUTCFullYear(), date.getUTCMonth(), date.getUTCDate(), min(sum % 86400, latest)];
};

// The uniforms that tell the time. iTick counts 1/65536 s, modulo 2^32.
export const timed = (time, delta, frame) => ({
    iTime: time, iGlobalTime: time, u_time: time, uTime: time, time, iTimeDelta: delta, u_delta: delta, iFrameRate: 1 / delta, iFrame: frame,
    u_frame: frame, iTick: floor(time % 65536 * 65536) >>> 0,
});

export const frameAt = (plan, time, delta, frame) => {
    const iDate = dateAfter(plan, time);
    return {...timed(time, delta, frame), iSampleRate: 44100, iDate, u_date: iDate};
};

// Frame k of a playback that ends at `end`; beyond its last one time stands still. What was done after `from` is new.
export const playedFrame = (plan, k, end) => {
    const last = lastFrame(end), at = i => i < last ? i / FPS : end, from = k ? at(k - 1) : -Infinity;
    return {...frameAt(plan, at(k), k && k <= last ? at(k) - from : 1 / FPS, k), from};
};

// Time that runs while it plays, by the clock of the browser; after a hitch it goes on where it stood.
export const makeClock = time => ({
    time,
    playing: true,
    last: null,
    // `now` in milliseconds; returns the seconds that passed, or 0.
    advance(now) {
        const passed = this.playing && this.last ? min((now - this.last) / 1000, 1) : 0;
        this.last = this.playing && now;
        this.time += passed;
        return passed;
    },
});

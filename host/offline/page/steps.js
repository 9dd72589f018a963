// Passes that run in steps of a length of their own. In a page alone that has such.
import {ceil, clamp, floor, max} from "./arithmetic.js";
import {timed} from "./clock.js";

// Whole steps of n/d seconds that have elapsed.
export const stepsDue = (time, [n, d]) => floor(time * d / n + 1e-6);

// Gives what runs all passes of one step length together, each step all of them, where the first of them stands.
export const makeSteps = (player, instant, drawPass) => {
    const clocks = {};
    return (step, frame) => {
        const [n, d] = step, {tape, longest = Infinity} = frame, clock = clocks[step] ??= {done: 0, reader: tape?.reader()};
        const due = stepsDue(frame.iTime, step);
        clock.done = clamp(ceil(due - max(longest * d / n, 1)), clock.done, due);
        for (; clock.done < due; ++clock.done) {
            const time = (clock.done + 1) * n / d, from = clock.done ? clock.done * n / d : -Infinity;
            const inner = {...frame, ...timed(time, n / d, clock.done), ...tape?.events.length && clock.reader.input(time, player.size, from)};
            instant(inner);
            for (const pass of player.live) if (`${pass.step}` === `${step}`) drawPass(pass, inner, true);
        }
        instant(frame);
    };
};

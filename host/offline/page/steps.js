// Passes that run in steps of a length of their own. In a page alone that has such.
import {stepsDue, timed} from "./clock.js";

// Gives what runs all passes of one step length together, each step all of them, where the first of them stands.
export function makeSteps(player, instant, drawPass) {
    const clocks = {};
    return ([n, d], frame) => {
        const step = `${n},${d}`, {tape, longest = Infinity} = frame, clock = clocks[step] ??= {done: 0, reader: tape?.reader()};
        const due = stepsDue(frame.iTime, [n, d]);
        clock.done = Math.max(Math.min(clock.done, due), Math.ceil(due - Math.max(longest * d / n, 1)));
        for (; clock.done < due; ++clock.done) {
            const time = (clock.done + 1) * n / d, from = clock.done ? clock.done * n / d : -Infinity;
            const inner = {...frame, ...timed(time, n / d, clock.done), ...tape?.events.length && clock.reader.input(time, player.size, from)};
            instant(inner);
            for (const pass of player.live) if (`${pass.step}` === step) drawPass(pass, inner, true);
        }
        instant(frame);
    };
}

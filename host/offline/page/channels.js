// What a pass is told of its four channels: sizes and times. In a page alone that asks.

import {floor, max} from "./arithmetic.js";

// Into its round; 0.3 s lies a rounding below three rounds of 0.1 s.
const inRound = (time, length) => max(time - floor(time / length + 1e-9) * length, 0);
const timeOf = (input, time) => input?.seconds ? inRound(time, input.seconds) : input?.plays ? time : 0;

export const channelsTold = (inputs, time, sizeOf) => {
    const told = {
        "iChannelTime[0]": inputs.map(input => timeOf(input, time)),
        "iChannelResolution[0]": inputs.flatMap(sizeOf),
    };
    inputs.forEach((input, i) => {
        told[`iCh${i}.size`] = sizeOf(input);
        told[`iCh${i}.time`] = timeOf(input, time);
        told[`iCh${i}.loaded`] = +(sizeOf(input)[0] > 0);
    });
    return told;
};

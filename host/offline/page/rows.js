// A sound as shaders see it: 512 bytes of spectrum, 512 of the wave for each 1/60 s, as the host wrote them. In a page
// alone that reads one.
import {floor, min} from "./arithmetic.js";

const ROW = 1024;

// `settled` blocks after the start a round is like the next one; the bytes tell those and one round more.
export const rowsOf = (bytes, {seconds, settled}) => {
    const round = bytes.length / ROW - settled;
    return ({iTime}) => {
        const block = floor(iTime / seconds) * round + min(floor(iTime % seconds * 60 + 1e-6), round - 1);
        const row = block < settled ? block : settled + (block - settled) % round;
        return bytes.subarray(row * ROW, (row + 1) * ROW);
    };
};

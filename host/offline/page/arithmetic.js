// Words that all modules share.

export const {ceil, exp, floor, imul, log, max, min, round} = Math;
export const clamp = (v, low, high) => min(max(v, low), high);
// `count` things, each made of its number.
export const list = (count, make) => Array.from({length: count}, (_, i) => make(i));

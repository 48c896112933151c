// bits.js - masks of a bit each: joined, counted and listed.

/** Puts the masks of parts one after another. starts: the first bit of each part, multiples of 32. */
export function joinBits(parts, starts, count) {
    const words = new Uint32Array(Math.ceil(count / 32));
    parts.forEach((part, p) => {
        if (part.length) words.set(part.subarray(0, words.length - starts[p] / 32), starts[p] / 32);
    });
    return words;
}

/** Sets in `words` every bit that is set in `others`. */
export function setBits(words, others) {
    for (let i = 0; i < words.length; i++) words[i] |= others[i];
}

export function countBits(words) {
    let count = 0;
    for (let word of words) {
        word -= (word >>> 1) & 0x55555555;
        word = (word & 0x33333333) + ((word >>> 2) & 0x33333333);
        count += Math.imul((word + (word >>> 4)) & 0x0f0f0f0f, 0x01010101) >>> 24;
    }
    return count;
}

/** The numbers of the set bits, ascending, at most `room` of them. */
export function listBits(words, room = Infinity) {
    const list = [];
    for (let w = 0; w < words.length && list.length < room; w++)
        for (let left = words[w]; left && list.length < room; left &= left - 1) list.push(32 * w + 31 - Math.clz32(left & -left));
    return list;
}

// cell_list.js - the cells that are set in the bits of a grid.

/**
 * The coordinates of the first `room` cells, by layers from below, and how many there are in all. Rows along x are whole pairs of
 * words.
 */
export function listCells(size, bits, room) {
    const rowWords = 2 * Math.ceil(size[0] / 64),
        at = new Uint16Array(3 * room);
    let count = 0;
    for (let w = 0; w < bits.length; w++) {
        if (!bits[w]) continue;
        const row = Math.floor(w / rowWords),
            first = 32 * (w % rowWords),
            j = row % size[1],
            k = Math.floor(row / size[1]);
        for (let left = bits[w]; left; left &= left - 1, count++)
            if (count < room) at.set([first + 31 - Math.clz32(left & -left), j, k], 3 * count);
    }
    const drawn = Math.min(count, room);
    return { at: at.slice(0, 3 * drawn), count, drawn };
}

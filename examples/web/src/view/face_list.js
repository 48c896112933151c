// face_list.js - the faces of cells that can be seen: between a cell that is set in the bits of a grid and one that is not.
import { countBits } from '../bits.js';

/**
 * Four numbers a face, the cell and its side, 2 * axis + end; and how many cells are set. Rows along x are whole pairs of words: 32
 * cells at once are compared with their neighbours. room: where there are more faces, none are listed, but counted.
 */
export function listFaces([, rows, layers], bits, room) {
    const rowWords = bits.length / rows / layers, layerWords = rowWords * rows;
    const beside = [
        (w, x) => (bits[w] << 1) | (x ? bits[w - 1] >>> 31 : 0),
        (w, x) => (bits[w] >>> 1) | (x < rowWords - 1 ? bits[w + 1] << 31 : 0),
        (w, x, j) => (j ? bits[w - rowWords] : 0),
        (w, x, j) => (j < rows - 1 ? bits[w + rowWords] : 0),
        (w, x, j, k) => (k ? bits[w - layerWords] : 0),
        (w, x, j, k) => (k < layers - 1 ? bits[w + layerWords] : 0),
    ];
    const at = new Uint16Array(4 * room);
    let faces = 0;
    for (let w = 0; w < bits.length; w++) {
        if (!bits[w]) continue;
        const x = w % rowWords, row = (w - x) / rowWords, j = row % rows, k = (row - j) / rows;
        for (let side = 0; side < 6; side++)
            for (let left = bits[w] & ~beside[side](w, x, j, k); left; left &= left - 1, faces++)
                if (faces < room) at.set([32 * x + 31 - Math.clz32(left & -left), j, k, side], 4 * faces);
    }
    return { at: at.subarray(0, faces > room ? 0 : 4 * faces), faces, count: countBits(bits) };
}

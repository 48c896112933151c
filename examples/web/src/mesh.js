// mesh.js - triangles, where they lie, and the grid of cells around them.

/** Bounds of the triangles that are finite; how many are not. */
export function boundsOf(triangles) {
    const lo = [Infinity, Infinity, Infinity],
        hi = [-Infinity, -Infinity, -Infinity];
    let notFinite = 0;
    for (let i = 0; i < triangles.length; i += 9) {
        let sum = 0;
        for (let k = 0; k < 9; k++) sum += triangles[i + k] * 0;
        if (sum !== 0) {
            notFinite++;
            continue;
        }
        for (let k = 0; k < 9; k++) {
            const x = triangles[i + k],
                a = k % 3;
            if (x < lo[a]) lo[a] = x;
            if (x > hi[a]) hi[a] = x;
        }
    }
    return { lo, hi, notFinite };
}

const ROUNDNESS = 1.25; // what is hardly a sphere may reach a little farther than 1

/** The middle of the bounds, and about half their diagonal: what the view makes 0 and 1. */
export function frameOf({ lo, hi }) {
    const middle = lo.map((l, a) => l / 2 + hi[a] / 2);
    const scale = Math.hypot(...lo.map((l, a) => hi[a] / 2 - l / 2)) / ROUNDNESS;
    return { middle, scale: Number.isFinite(scale) && scale > 0 ? scale : 1 };
}

const buffer = new DataView(new ArrayBuffer(4));

/** The next float above a positive one. */
function nextFloat(x) {
    buffer.setFloat32(0, x);
    buffer.setUint32(0, buffer.getUint32(0) + 1);
    return buffer.getFloat32(0);
}

const plane = (origin, cell, p) => Math.fround(origin + p * cell);

/** Cubes, so many along the longest side, that just reach its end: the grid of `tribox voxelize --resolution`. */
export function gridAround({ lo, hi }, resolution) {
    const sides = lo.map((l, a) => hi[a] - l),
        longest = sides.indexOf(Math.max(...sides));
    if (!(sides[longest] > 0)) throw new Error('the whole mesh lies in one point: there is no grid around it');
    let cell = Math.fround(sides[longest] / resolution);
    while (plane(lo[longest], cell, resolution) < hi[longest]) cell = nextFloat(cell);
    const size = lo.map((l, a) => {
        let cells = Math.max(1, Math.floor(sides[a] / cell) - 1);
        while (plane(l, cell, cells) < hi[a]) cells++;
        return cells;
    });
    return { origin: lo, cell: [cell, cell, cell], size };
}

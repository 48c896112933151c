// mesh.js - triangles, and where they lie.

/** Bounds of the triangles that are finite; how many are not. */
export function boundsOf(triangles) {
    const lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity];
    let notFinite = 0;
    for (let i = 0; i < triangles.length; i += 9) {
        let sum = 0;
        for (let k = 0; k < 9; k++) sum += triangles[i + k] * 0;
        if (sum !== 0) {
            notFinite++;
            continue;
        }
        for (let k = 0; k < 9; k++) {
            const x = triangles[i + k], a = k % 3;
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

/** Where the view has them; what is not finite is at 0. */
export function placesOf(triangles, { middle, scale }) {
    const places = new Float32Array(triangles.length);
    for (let i = 0; i < places.length; i++) {
        const place = (triangles[i] - middle[i % 3]) / scale;
        places[i] = Number.isFinite(place) ? place : 0;
    }
    return places;
}

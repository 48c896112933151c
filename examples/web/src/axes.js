// axes.js - the shadows that a triangle and the cube from -1 to 1 cast on an axis. They are for drawing alone: whether the two
// overlap is for the library to say.
export const cross = (u, v) => [0, 1, 2].map((a) => u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3]);
export const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];

/** As it is written. */
export const nameOf = ({ letter, number }) => letter + number.replace(/\d/g, (digit) => '₀₁₂'[digit]);

export const verticesOf = (triangle) => [0, 3, 6].map((at) => Array.from(triangle.slice(at, at + 3)));

/**
 * The triangle's shadow on an axis, lo to hi; that of the cube is -r to r. gap: what lies between, 0 if they touch or overlap.
 * Exact for multiples of 1/64 below 8 on the axes below, as all products then fit a double.
 */
export function shadowsOf(axis, vertices) {
    const places = vertices.map((v) => dot(axis, v)), r = Math.abs(axis[0]) + Math.abs(axis[1]) + Math.abs(axis[2]);
    const lo = Math.min(...places), hi = Math.max(...places);
    return { axis, lo, hi, r, gap: Math.max(lo - r, -r - hi, 0) };
}

const UNIT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/**
 * The thirteen of the paper, in its letters: e for normals of the box, n for that of the triangle, a for the cross product of a
 * normal and an edge. edges: which.
 */
export function axesOf(triangle) {
    const vertices = verticesOf(triangle), edges = [0, 1, 2].map((j) => vertices[(j + 1) % 3].map((x, a) => x - vertices[j][a]));
    return [
        ...UNIT.map((e, i) => ({ letter: 'e', number: `${i}`, group: 'box', ...shadowsOf(e, vertices) })),
        { letter: 'n', number: '', group: 'plane', ...shadowsOf(cross(edges[0], edges[1]), vertices) },
        ...UNIT.flatMap((e, i) =>
            edges.map((f, j) => ({
                ...{ letter: 'a', number: `${i}${j}`, group: 'edges', edges: [i, j] },
                ...shadowsOf(cross(e, f), vertices),
            })),
        ),
    ];
}

// axes.js - the thirteen axes of the paper about one triangle and the cube from -1 to 1: where each sees both, and the gap between.

const UNIT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

const cross = (u, v) => [0, 1, 2].map((a) => u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3]);
const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];

/** The paper's letters: e for normals of the box, n for that of the triangle, a for the cross product of a normal and an edge. */
function directions(vertices) {
    const edges = [0, 1, 2].map((j) => vertices[(j + 1) % 3].map((x, a) => x - vertices[j][a]));
    return [
        ...UNIT.map((e, i) => ({ letter: 'e', number: `${i}`, group: 'box', axis: e })),
        { letter: 'n', number: '', group: 'plane', axis: cross(edges[0], edges[1]) },
        ...UNIT.flatMap((e, i) => edges.map((f, j) => ({ letter: 'a', number: `${i}${j}`, group: 'edges', axis: cross(e, f) }))),
    ];
}

/**
 * The interval of the triangle on each axis, lo to hi; that of the cube is -r to r. gap: what lies between, 0 where they touch or
 * overlap. Exact for multiples of 1/64 below 8, as all products then fit a double.
 */
export function axesOf(triangle) {
    const vertices = [0, 3, 6].map((at) => Array.from(triangle.slice(at, at + 3)));
    return directions(vertices).map(({ axis, ...name }) => {
        const places = vertices.map((v) => dot(axis, v)), r = Math.abs(axis[0]) + Math.abs(axis[1]) + Math.abs(axis[2]);
        const lo = Math.min(...places), hi = Math.max(...places);
        return { ...name, lo, hi, r, gap: Math.max(lo - r, -r - hi, 0) };
    });
}

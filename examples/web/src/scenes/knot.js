// knot.js - the mesh of `tribox demo`: a tube along a knot that winds twice around a torus and three times through its hole.

const RADIUS = 2, SWING = 0.85, TUBE = 0.42;

function knotPoint(t, turn, to, at) {
    const cp = Math.cos(2 * t), sp = Math.sin(2 * t), cq = Math.cos(3 * t), sq = Math.sin(3 * t), rho = RADIUS + SWING * cq;
    const center = [rho * cp, rho * sp, SWING * sq];
    const outward = [cq * cp, cq * sp, sq]; // normal to the torus and so to the knot
    const along = [-3 * SWING * sq * cp - 2 * rho * sp, -3 * SWING * sq * sp + 2 * rho * cp, 3 * SWING * cq];
    const length = Math.hypot(...along);
    for (let a = 0; a < 3; a++) {
        const b = (a + 1) % 3, c = (a + 2) % 3;
        const sideward = (along[b] * outward[c] - along[c] * outward[b]) / length;
        to[at + a] = center[a] + TUBE * (Math.cos(turn) * outward[a] + Math.sin(turn) * sideward);
    }
}

/** Two triangles for each corner of each ring; nine floats a triangle. */
export function knot(rings, corners) {
    const points = new Float32Array(3 * rings * corners);
    for (let ring = 0; ring < rings; ring++)
        for (let corner = 0; corner < corners; corner++)
            knotPoint((2 * Math.PI * ring) / rings, (2 * Math.PI * corner) / corners, points, 3 * (ring * corners + corner));
    const triangles = new Float32Array(18 * rings * corners);
    let at = 0;
    const put = (ring, corner) => {
        const from = 3 * ((ring % rings) * corners + (corner % corners));
        for (let a = 0; a < 3; a++) triangles[at++] = points[from + a];
    };
    for (let ring = 0; ring < rings; ring++)
        for (let corner = 0; corner < corners; corner++) {
            (put(ring, corner), put(ring + 1, corner), put(ring + 1, corner + 1));
            (put(ring, corner), put(ring + 1, corner + 1), put(ring, corner + 1));
        }
    return triangles;
}

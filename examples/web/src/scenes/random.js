// random.js - scenes that are drawn: the paper's, and one of triangles that touch the box.

/** Mulberry32: uniform in [0, 1), the same from the same seed everywhere. */
function generator(seed) {
    return () => {
        seed = (seed + 0x6d2b79f5) | 0;
        let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

/** The paper's experiment: vertices uniform in a cube four times as long as the box. */
export function paperScene(count) {
    const random = generator(2001);
    return Float32Array.from({ length: 9 * count }, () => 4 * random() - 2);
}

/**
 * Triangles that come within rounding of contact with the cube from -1 to 1: the line between two vertices passes through an
 * edge of it, as nearly as floats can, and the third vertex lies beyond. FAST cannot tell on which side. size: 1 for small ones.
 */
export function tiesScene(count, size = 1) {
    const random = generator(7), triangles = new Float32Array(9 * count);
    for (let i = 0; i < count; i++) {
        const axis = Math.floor(3 * random()), b = (axis + 1) % 3, c = (axis + 2) % 3;
        const sb = random() < 0.5 ? -1 : 1, sc = random() < 0.5 ? -1 : 1;
        const at = 2 * random() - 1; // where on the edge
        const slope = 0.2 + random(), length = size * (0.06 + 0.1 * random()), rise = (random() - 0.5) * length;
        const place = (v, along, db, dc) => {
            triangles[9 * i + 3 * v + axis] = at + along;
            triangles[9 * i + 3 * v + b] = sb * (1 + db);
            triangles[9 * i + 3 * v + c] = sc * (1 + dc);
        };
        place(0, rise, length, -length * slope);
        place(1, -rise * 0.7, -0.7 * length, 0.7 * length * slope);
        place(2, rise * random(), (0.2 + 0.6 * random()) * length, (0.5 + random()) * length * slope);
    }
    return triangles;
}

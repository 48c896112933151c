// sample.js - a few triangles in place of a mesh that is more than is drawn, each with the number of one of the mesh.

/** How many triangles are drawn of those that have this area each, where the picture has 4. */
export const roomFor = (area, { triangles, covers }) => Math.min(triangles, Math.max(100, Math.floor((4 * covers) / area)));

/** The area of a triangle, on the average of some. */
export function areaOf(places) {
    const step = 9 * Math.ceil(places.length / 9 / 1000);
    let sum = 0,
        count = 0;
    for (let i = 0; i < places.length; i += step, count++) {
        const [ux, uy, uz, vx, vy, vz] = [3, 4, 5, 6, 7, 8].map((k) => places[i + k] - places[i + (k % 3)]);
        sum += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
    }
    return sum / count;
}

/** Some of the triangles; larger by `growth`, to cover what those between them did. */
export function someOf(places, room, growth) {
    const count = places.length / 9,
        step = Math.ceil(count / room),
        numbers = new Uint32Array(Math.floor(count / step)),
        some = new Float32Array(9 * numbers.length);
    for (let i = 0; i < numbers.length; i++) {
        numbers[i] = i * step + ((Math.imul(i, 0x9e3779b1) >>> 8) % step); // not in rows
        const nine = places.subarray(9 * numbers[i], 9 * numbers[i] + 9);
        for (let k = 0; k < 9; k++) {
            const middle = (nine[k % 3] + nine[3 + (k % 3)] + nine[6 + (k % 3)]) / 3;
            some[9 * i + k] = middle + growth * (nine[k] - middle);
        }
    }
    return { places: some, numbers };
}

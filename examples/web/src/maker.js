// maker.js - a Worker that makes a scene, or reads a file, and ends: triangles, where they lie, and which of them are drawn.
import { boundsOf, frameOf, placesOf } from './mesh.js';
import { readMesh } from './read.js';
import { scenes } from './scenes/scenes.js';
import { serve } from './serve.js';

/** How many triangles are drawn of those that have this area each, where the picture has 4. */
const roomFor = (area, { triangles, covers }) => Math.min(triangles, Math.max(100, Math.floor((4 * covers) / area)));

/** The area of a triangle, on the average of some. */
function areaOf(places) {
    const step = 9 * Math.ceil(places.length / 9 / 1000);
    let sum = 0, count = 0;
    for (let i = 0; i < places.length; i += step, count++) {
        const [ux, uy, uz, vx, vy, vz] = [3, 4, 5, 6, 7, 8].map((k) => places[i + k] - places[i + (k % 3)]);
        sum += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
    }
    return sum / count;
}

/** Some of the triangles; larger by `growth`, to cover what those between them did. */
function someOf(places, room, growth) {
    const count = places.length / 9, step = Math.ceil(count / room),
        numbers = new Uint32Array(Math.floor(count / step)), some = new Float32Array(9 * numbers.length);
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

/** A part of what there is room for is left to those that straddle. Small triangles are drawn larger, to cover what all did. */
function sampleOf(places, frame, most, coarse) {
    const room = roomFor(areaOf(places), most), count = places.length / 9, part = Math.floor(room / 2);
    if (count <= room) return null;
    if (!coarse) return someOf(places, part, room < most.triangles ? 1 : Math.sqrt((2 * count) / part));
    const { triangles, numbers } = coarse(part);
    return { places: placesOf(triangles, frame), numbers };
}

function shown({ name, triangles, up, frame, coarse }, most) {
    const bounds = boundsOf(triangles);
    if (!(bounds.lo[0] <= bounds.hi[0]))
        throw new Error(`${name}: none of its triangles has finite coordinates. Export it again.`);
    frame ??= frameOf(bounds);
    const places = placesOf(triangles, frame);
    return { name, triangles, up, bounds, frame, places, sample: sampleOf(places, frame, most, coarse) };
}

serve({
    make: ({ scene, most }) => shown({ ...scenes[scene], triangles: scenes[scene].make(), up: 'z' }, most),
    read: async ({ file, reader, most }, say) => shown(await readMesh(file, reader, say), most),
    place: ({ mesh, most }) => shown(mesh, most),
});

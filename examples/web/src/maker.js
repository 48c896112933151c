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

/** Some of the triangles. */
function someOf(places, room) {
    const count = places.length / 9, step = Math.ceil(count / room),
        numbers = new Uint32Array(Math.floor(count / step)), some = new Float32Array(9 * numbers.length);
    for (let i = 0; i < numbers.length; i++) {
        numbers[i] = i * step + ((Math.imul(i, 0x9e3779b1) >>> 8) % step); // not in rows
        some.set(places.subarray(9 * numbers[i], 9 * numbers[i] + 9), 9 * i);
    }
    return { places: some, numbers };
}

const FINEST = 160;

/**
 * All of it, coarser: vertices in the same cell of a grid become one, in their middle, and triangles are left that have three. If
 * there is no room for these, how many they are.
 */
function coarseOf(places, room, cells) {
    const cellOf = new Uint32Array(places.length / 3), numbers = [];
    const along = (x) => Math.floor(Math.min(0.999, Math.max(0, 0.5 + x / 2.6)) * cells);
    for (let v = 0, at = 0; v < cellOf.length; v++, at += 3)
        cellOf[v] = (along(places[at]) * cells + along(places[at + 1])) * cells + along(places[at + 2]);
    for (let v = 0; v < cellOf.length; v += 3) {
        const p = cellOf[v], q = cellOf[v + 1], r = cellOf[v + 2];
        if (p !== q && q !== r && r !== p) numbers.push(v / 3);
    }
    if (numbers.length > room) return { count: numbers.length };
    const sums = new Float32Array(4 * cells ** 3); // and how many
    for (let v = 0; v < cellOf.length; v++) {
        for (let a = 0; a < 3; a++) sums[4 * cellOf[v] + a] += places[3 * v + a];
        sums[4 * cellOf[v] + 3]++;
    }
    const coarse = new Float32Array(9 * numbers.length);
    for (let i = 0; i < coarse.length; i++) {
        const cell = cellOf[3 * numbers[Math.floor(i / 9)] + Math.floor((i % 9) / 3)];
        coarse[i] = sums[4 * cell + (i % 3)] / sums[4 * cell + 3];
    }
    return { places: coarse, numbers: Uint32Array.from(numbers) };
}

/** A part of what there is room for is left to those that straddle. */
function sampleOf(places, most) {
    const room = roomFor(areaOf(places), most), count = places.length / 9, part = Math.floor(room / 2);
    if (count <= room) return null;
    if (room < most.triangles) return someOf(places, part);
    let cells = FINEST, coarse = coarseOf(places, part, cells);
    for (; coarse.count; coarse = coarseOf(places, part, cells)) cells = Math.floor(0.97 * cells * Math.sqrt(part / coarse.count));
    return coarse.numbers.length > part / 16 ? coarse : someOf(places, part); // it may be specks, each in a cell
}

function shown({ name, triangles, up, frame }, most) {
    const bounds = boundsOf(triangles);
    if (!(bounds.lo[0] <= bounds.hi[0]))
        throw new Error(`${name}: none of its triangles has finite coordinates. Export it again.`);
    frame ??= frameOf(bounds);
    const places = placesOf(triangles, frame);
    return { name, triangles, up, bounds, frame, places, sample: sampleOf(places, most) };
}

serve({
    make: ({ scene, most }) => shown({ ...scenes[scene], triangles: scenes[scene].make(), up: 'z' }, most),
    read: async ({ file, reader, most }, say) => shown(await readMesh(file, reader, say), most),
    place: ({ mesh, most }) => shown(mesh, most),
});

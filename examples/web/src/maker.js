// maker.js - a Worker that makes a scene, or reads a file, and ends: triangles, where they lie, and which of them are drawn.
import { boundsOf, frameOf, placesOf } from './mesh.js';
import { readMesh } from './read.js';
import { areaOf, roomFor, someOf } from './sample.js';
import { scenes } from './scenes/scenes.js';
import { serve } from './serve.js';

/** A part of what there is room for is left to those that straddle. Small triangles are drawn larger, to cover what all did. */
function sampleOf(places, frame, most, coarse) {
    const room = roomFor(areaOf(places), most),
        count = places.length / 9,
        part = Math.floor(room / 2);
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

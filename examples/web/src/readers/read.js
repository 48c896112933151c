// read.js - a file that was dropped, as triangles of nine floats each; or an error that says what, where and what to do.
import { readGlb } from './glb.js';
import { refuseTooMany } from './limit.js';
import { readObj } from './obj.js';
import { readOff } from './off.js';
import { readPly } from './ply.js';
import { readStl } from './stl.js';

/** Which axis is up is not written in most files: what programs that write them mostly mean. */
const formats = {
    stl: { read: readStl, up: 'z' },
    obj: { read: readObj, up: 'y' },
    ply: { read: readPly, up: 'y' },
    off: { read: readOff, up: 'z' },
    glb: { read: readGlb, up: 'y' },
};

const endingOf = (name) => (name.includes('.') ? name.slice(name.lastIndexOf('.') + 1).toLowerCase() : '');

export async function readMesh(file) {
    const format = formats[endingOf(file.name)];
    if (!format)
        throw new Error(
            `${file.name}: not a kind of file that this page reads. Export the mesh as .stl, .obj, .ply, .off or .glb.`,
        );
    if (!file.size) throw new Error(`${file.name}: the file is empty. Export or download it again.`);
    let triangles;
    try {
        triangles = await format.read(await file.arrayBuffer());
        refuseTooMany(triangles.length / 9);
    } catch (error) {
        throw new Error(`${file.name}: ${error.message}`);
    }
    if (!triangles.length)
        throw new Error(`${file.name}: holds no triangles. Points and lines alone have no surface to test; export faces.`);
    return { name: file.name, triangles, up: format.up };
}

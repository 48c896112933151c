// stl.js - STL files, binary by three's loader, or text; a file that ends early is refused before.
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
import { trianglesOf } from './geometry.js';
import { refuseTooMany } from './limit.js';
import { readStlText } from './stl_text.js';

const HEADER = 84,
    TRIANGLE = 50;

const startsAsText = (bytes) => new TextDecoder().decode(bytes.subarray(0, 10)).includes('solid');

export function readStl(buffer) {
    const bytes = new Uint8Array(buffer);
    if (bytes.length < HEADER && !startsAsText(bytes))
        throw new Error(`ends after ${bytes.length} bytes, within the header of an STL file. Export or download it again.`);
    const promised = bytes.length < HEADER ? 0 : new DataView(buffer).getUint32(80, true);
    const isBinary = bytes.length === HEADER + TRIANGLE * promised;
    if (!isBinary && !startsAsText(bytes)) {
        const there = Math.floor((bytes.length - HEADER) / TRIANGLE);
        throw new Error(
            `its header promises ${promised.toLocaleString('en')} triangles, and the file has room for ` +
                `${there.toLocaleString('en')}. Export or download it again.`,
        );
    }
    if (isBinary) {
        refuseTooMany(promised);
        return trianglesOf(new STLLoader().parse(buffer));
    }
    if (!new TextDecoder().decode(bytes.subarray(-200)).includes('endsolid'))
        throw new Error('ends before the line endsolid: the file is cut. Export or download it again.');
    return readStlText(new TextDecoder().decode(buffer));
}

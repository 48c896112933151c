// ply.js - PLY files, binary or text, by three's loader, which takes faces of three or four corners.
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { trianglesOf } from './geometry.js';

export function readPly(buffer) {
    const header = new TextDecoder().decode(buffer.slice(0, 65536)).match(/^ply[\s\S]*?end_header/);
    if (!header) throw new Error('does not begin with ply and a header. Is it a PLY file?');
    if (header[0].includes('format ascii')) checkLines(header[0], buffer);
    const faces = Number(header[0].match(/element face (\d+)/)?.[1] ?? 0);
    let triangles;
    try {
        triangles = facesOf(new PLYLoader().parse(buffer), faces);
    } catch (error) {
        if (error instanceof RangeError) throw new Error('ends before all that its header promises. Export or download it again.');
        throw error;
    }
    if (!faces) return new Float32Array(0);
    if (triangles.length / 9 < faces)
        throw new Error('has faces of more than four corners, or is cut. Cut the faces into triangles, and export it again.');
    return triangles;
}

/** The loader reads what is missing from a text as zeros. */
function checkLines(header, buffer) {
    const lines = new TextDecoder()
        .decode(buffer)
        .slice(header.length)
        .split('\n')
        .filter((line) => line.trim()).length;
    const promised = [...header.matchAll(/element \w+ (\d+)/g)].reduce((sum, [, count]) => sum + Number(count), 0);
    if (lines < promised)
        throw new Error(`its header promises ${promised} lines, and there are ${lines}. Export or download it again.`);
}

/** Where the loader has left out all faces it returns the vertices alone. */
const facesOf = (geometry, faces) => (faces && !geometry.index ? new Float32Array(0) : trianglesOf(geometry));

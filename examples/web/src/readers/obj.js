// obj.js - OBJ files by three's loader. Polygons become fans.
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { trianglesUnder } from './geometry.js';

export function readObj(buffer) {
    const text = new TextDecoder().decode(buffer);
    if (!/^\s*v\s/m.test(text)) throw new Error('has no line that begins with v: no vertices. Is it an OBJ file?');
    return trianglesUnder(new OBJLoader().parse(withoutLines(text)));
}

/** The same text without lines and points: an object with one of them has no faces for the loader. */
const withoutLines = (text) => text.replace(/\\\r?\n/g, ' ').replace(/^[ \t]*[lp].*$/gm, '');

// stl_text.js - STL files that are text: solids of facets, each a normal, which is left out, and three vertices.
import { refuseTooMany } from './limit.js';

const VERTEX = String.raw`vertex\s+(\S+)\s+(\S+)\s+(\S+)\s+`;
const NORMAL = String.raw`normal\s+\S+\s+\S+\s+\S+\s+`;
const FACET = new RegExp(String.raw`facet\s+${NORMAL}outer\s+loop\s+${VERTEX.repeat(3)}endloop\s+endfacet\s+`, 'iy');
const SOLID = /\s*solid.*\s*/iy; // with its name
const ENDSOLID = /endsolid.*\s*/iy;
const NOT_FINITE = /^[-+]?(nan|inf)/i; // as programs write it: NaN, -inf, infinity

/** Not a number is one too: the triangle overlaps nothing, and the page says so. */
function numberOf(word, facet) {
    const number = Number(word);
    if (Number.isNaN(number) && !NOT_FINITE.test(word))
        throw new Error(`facet ${facet} has "${word.slice(0, 40)}" in place of a number. Export it again.`);
    return number;
}

export function readStlText(text) {
    const numbers = [];
    let at = 0,
        facets = 0;
    const take = (pattern) => {
        pattern.lastIndex = at;
        const found = pattern.exec(text);
        if (found) at = pattern.lastIndex;
        return found;
    };
    const there = () => text.slice(at, at + 60).replace(/\s+/g, ' ').trim();
    while (take(SOLID)) {
        for (let facet = take(FACET); facet; facet = take(FACET), facets++) {
            refuseTooMany(facets + 1);
            for (const word of facet.slice(1)) numbers.push(numberOf(word, facets));
        }
        if (!take(ENDSOLID))
            throw new Error(`facet ${facets}, "${there()}", is not a normal and three vertices of x, y and z. Export it again.`);
    }
    if (at < text.length) throw new Error(`has "${there()}" after facet ${facets - 1} and endsolid. Export it again.`);
    return Float32Array.from(numbers);
}

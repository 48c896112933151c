// off.js - OFF files as text: OFF, counts, then a line for each vertex and each face. Polygons become fans.
import { refuseTooMany } from './limit.js';

const CUT = 'Export or download it again.';

export function readOff(buffer) {
    const text = new TextDecoder().decode(buffer).replace(/#.*/g, '');
    const begin = text.match(/^\s*(ST)?(C)?(N)?OFF(\s+BINARY)?/);
    if (!begin || begin[4]) throw new Error('does not begin with the word OFF. Is it an OFF file, as text?');
    if (begin[1] || begin[2] || begin[3])
        throw new Error(`is of the kind ${begin[0].trim()}, whose vertices have more than x, y and z. Export it as plain OFF.`);
    const counts = text.slice(begin[0].length).match(/^\s*(\d+)\s+(\d+).*/); // with that of edges
    if (!counts) throw new Error(`has no numbers of vertices and faces after the word OFF. ${CUT}`);
    const rows = text
        .slice(begin[0].length + counts[0].length)
        .split(/[\r\n]+/)
        .map((line) => line.trim())
        .filter(Boolean);
    const vertices = Number(counts[1]),
        faces = Number(counts[2]);
    const points = pointsOf(rows, vertices);
    if (rows.length !== vertices + faces)
        throw new Error(
            `promises ${faces} faces; lines after the ${vertices} of its vertices: ${rows.length - vertices}. ${CUT}`,
        );
    return trianglesOf(rows.slice(vertices), points);
}

/** The first rows: x, y and z, and more that is left out. */
function pointsOf(rows, vertices) {
    const points = new Float32Array(3 * Math.min(vertices, rows.length));
    for (let i = 0; i < vertices; i++) {
        if (i >= rows.length) throw new Error(`ends before vertex ${i} of ${vertices}: the file is cut. ${CUT}`);
        const words = rows[i].split(/\s+/);
        for (let a = 0; a < 3; a++) {
            points[3 * i + a] = Number(words[a]);
            if (Number.isNaN(Number(words[a])))
                throw new Error(`has "${words[a] ?? ''}" in place of a number: vertex ${i}. Export it again.`);
        }
    }
    return points;
}

/** A number of corners, as many numbers of vertices, and more that is left out: a colour. */
function trianglesOf(rows, points) {
    const triangles = [];
    rows.forEach((row, face) => {
        const [corners, ...numbers] = row.split(/\s+/).map(Number);
        const polygon = numbers.slice(0, corners);
        if (!(polygon.length === corners && polygon.every((v) => v >= 0 && 3 * v < points.length)))
            throw new Error(`face ${face}, "${row.slice(0, 40)}", does not name vertices that are there. Export it again.`);
        refuseTooMany(triangles.length / 9 + corners - 2);
        for (let c = 2; c < corners; c++)
            for (const v of [polygon[0], polygon[c - 1], polygon[c]])
                triangles.push(points[3 * v], points[3 * v + 1], points[3 * v + 2]);
    });
    return Float32Array.from(triangles);
}

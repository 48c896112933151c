// off.js - OFF files as text: OFF, counts, vertices, faces. Polygons become fans.

export function readOff(buffer) {
    const text = new TextDecoder().decode(buffer).replace(/#.*/g, '');
    const words = text.split(/\s+/).filter(Boolean);
    const kind = words[0].match(/^(ST)?(C)?(N)?OFF(\d.*)?$/);
    if (!kind || words[1] === 'BINARY') throw new Error('does not begin with the word OFF. Is it an OFF file, as text?');
    if (kind[1] || kind[2] || kind[3])
        throw new Error(`is of the kind ${words[0]}, whose vertices have more than x, y and z. Export it as plain OFF.`);
    let at = 1;
    const next = (what) => {
        const number = Number(words[at]);
        if (at >= words.length) throw new Error(`ends before ${what}: the file is cut. Export or download it again.`);
        if (Number.isNaN(number)) throw new Error(`has "${words[at]}" in place of a number: ${what}. Export it again.`);
        at++;
        return number;
    };
    const vertices = next('the number of vertices'),
        faces = next('the number of faces');
    next('the number of edges');
    const points = new Float32Array(Math.min(3 * vertices, 3 * words.length));
    for (let i = 0; i < vertices; i++) for (let a = 0; a < 3; a++) points[3 * i + a] = next(`vertex ${i}`);
    const lines = text.split('\n'); // what follows the corners of a face on its line is a colour
    return trianglesOfFaces(lines, vertices, faces, points);
}

/** Faces are the last lines that are not blank: a number of corners, and as many numbers of vertices. */
function trianglesOfFaces(lines, vertices, faces, points) {
    const rows = lines
        .map((line) => line.trim())
        .filter(Boolean)
        .slice(-faces || Infinity);
    if (rows.length < faces) throw new Error(`promises ${faces} faces and has ${rows.length}. Export or download it again.`);
    const triangles = [];
    rows.forEach((row, face) => {
        const [corners, ...numbers] = row.split(/\s+/).map(Number);
        const polygon = numbers.slice(0, corners);
        if (polygon.length < corners || polygon.some((v) => !(v >= 0 && v < vertices)))
            throw new Error(`face ${face}, "${row.slice(0, 40)}", does not name vertices that are there. Export it again.`);
        for (let c = 2; c < corners; c++)
            for (const v of [polygon[0], polygon[c - 1], polygon[c]])
                triangles.push(points[3 * v], points[3 * v + 1], points[3 * v + 2]);
    });
    return Float32Array.from(triangles);
}

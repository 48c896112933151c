// ply.js - PLY files, binary or text. Polygons become fans. (three's loader leaves out faces of five corners and more.)
import { refuseTooMany } from './limit.js';

const BYTES = { char: 1, uchar: 1, short: 2, ushort: 2, int: 4, uint: 4, float: 4, double: 8 };
const LONG = {
    int8: 'char',
    uint8: 'uchar',
    int16: 'short',
    uint16: 'ushort',
    int32: 'int',
    uint32: 'uint',
    float32: 'float',
    float64: 'double',
};
const READ = {
    char: 'getInt8',
    uchar: 'getUint8',
    short: 'getInt16',
    ushort: 'getUint16',
    int: 'getInt32',
    uint: 'getUint32',
    float: 'getFloat32',
    double: 'getFloat64',
};
const CUT = 'Export or download it again.';

function typeOf(word) {
    const type = LONG[word] ?? word;
    if (!BYTES[type]) throw new Error(`its header has the type ${word}, which PLY does not. Export it again.`);
    return type;
}

/** The elements of a header, each with its properties; where it ends. */
function headerOf(buffer) {
    const text = new TextDecoder('latin1').decode(buffer.slice(0, 65536)).match(/^ply\r?\n[\s\S]*?end_header\r?\n/)?.[0];
    if (!text) throw new Error('does not begin with ply and a header. Is it a PLY file?');
    const elements = [];
    let format = '';
    for (const [word, ...rest] of text.split(/\r?\n/).map((line) => line.trim().split(/\s+/))) {
        if (word === 'format') [format] = rest;
        if (word === 'element') elements.push({ name: rest[0], count: Number(rest[1]), properties: [] });
        if (word === 'property') {
            const isList = rest[0] === 'list',
                types = rest.slice(isList ? 1 : 0, -1).map(typeOf);
            elements.at(-1)?.properties.push({ name: rest.at(-1), type: types.at(-1), countType: isList ? types[0] : null });
        }
    }
    return { elements, format, length: text.length };
}

/** Returns what reads the next number of a type. */
function numbersIn(buffer, { format, length }) {
    if (format !== 'ascii') {
        const view = new DataView(buffer, length),
            isLittle = format === 'binary_little_endian';
        let at = 0;
        return (type) => {
            const number = view[READ[type]](at, isLittle);
            at += BYTES[type];
            return number;
        };
    }
    const words = new TextDecoder().decode(new Uint8Array(buffer, length)).split(/\s+/).filter(Boolean);
    let at = 0;
    return () => {
        if (at >= words.length) throw new RangeError();
        return Number(words[at++]);
    };
}

/** Calls onRow with the numbers of each row of an element, lists as arrays. */
function readRows({ name, count, properties }, next, onRow) {
    const row = {};
    for (let i = 0; i < count; i++) {
        try {
            for (const p of properties)
                row[p.name] = p.countType ? Array.from({ length: next(p.countType) }, () => next(p.type)) : next(p.type);
        } catch (error) {
            if (!(error instanceof RangeError)) throw error;
            throw new Error(`ends at ${name} ${i} of ${count}: the file is cut. ${CUT}`);
        }
        onRow(row, i);
    }
}

export function readPly(buffer) {
    const header = headerOf(buffer),
        next = numbersIn(buffer, header),
        triangles = [];
    let points = new Float32Array(0);
    const addFan = (corners, face) => {
        refuseTooMany(triangles.length / 9 + corners.length - 2);
        for (let c = 2; c < corners.length; c++)
            for (const v of [corners[0], corners[c - 1], corners[c]]) {
                if (!(v >= 0 && 3 * v < points.length))
                    throw new Error(
                        `face ${face} refers to vertex ${v}, and there are ${points.length / 3}. Export the mesh again.`,
                    );
                triangles.push(points[3 * v], points[3 * v + 1], points[3 * v + 2]);
            }
    };
    for (const element of header.elements) {
        const { name, count } = element;
        if (name === 'vertex') {
            if (3 * count > buffer.byteLength) throw new Error(`promises ${count} vertices, and has no room for them. ${CUT}`);
            points = new Float32Array(3 * count);
            readRows(element, next, ({ x, y, z }, i) => points.set([x, y, z], 3 * i));
        } else if (name === 'face') readRows(element, next, (row, i) => addFan(row.vertex_indices ?? row.vertex_index ?? [], i));
        else readRows(element, next, () => {});
    }
    return Float32Array.from(triangles);
}

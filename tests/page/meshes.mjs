// meshes.mjs - triangles of nine floats each as files of every kind that the page reads, in a folder of their own.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { knot } from '../../examples/web/src/scenes/knot.js';
import { tiesScene } from '../../examples/web/src/scenes/random.js';

export const folder = mkdtempSync(join(tmpdir(), 'tribox-page-'));
process.on('exit', () => rmSync(folder, { recursive: true }));

export function write(name, content) {
    const path = join(folder, name);
    writeFileSync(path, content);
    return path;
}

export const raw = (name, triangles) => write(name, new Uint8Array(triangles.buffer));

/** The meshes that the page has itself, as its scripts make them. */
export const coarse = knot(250, 20);
export const ties = tiesScene(600);
export const coarseFile = raw('coarse.f32', coarse);
export const tiesFile = raw('ties.f32', ties);

/** Small, and with numbers that no short decimal is. */
export const small = knot(30, 7);

const corner = (triangles, v) => Array.from(triangles.subarray(3 * v, 3 * v + 3));
const corners = (triangles) => Array.from({ length: triangles.length / 3 }, (_, v) => corner(triangles, v));
const faces = (triangles) => Array.from({ length: triangles.length / 9 }, (_, i) => [3 * i, 3 * i + 1, 3 * i + 2]);

export function stlBytes(triangles) {
    const count = triangles.length / 9, bytes = new DataView(new ArrayBuffer(84 + 50 * count));
    bytes.setUint32(80, count, true);
    for (let i = 0; i < triangles.length; i++) bytes.setFloat32(84 + 50 * Math.floor(i / 9) + 12 + 4 * (i % 9), triangles[i], true);
    return new Uint8Array(bytes.buffer);
}

export function plyBytes(triangles) {
    const count = triangles.length / 9, header = new TextEncoder().encode(
        `ply\nformat binary_little_endian 1.0\nelement vertex ${3 * count}\nproperty float x\nproperty float y\n` +
        `property float z\nelement face ${count}\nproperty list uchar int vertex_indices\nend_header\n`);
    const bytes = new Uint8Array(header.length + 4 * triangles.length + 13 * count), view = new DataView(bytes.buffer);
    bytes.set(header);
    triangles.forEach((number, i) => view.setFloat32(header.length + 4 * i, number, true));
    for (let i = 0, at = header.length + 4 * triangles.length; i < count; i++, at += 13) {
        view.setUint8(at, 3);
        for (let v = 0; v < 3; v++) view.setInt32(at + 1 + 4 * v, 3 * i + v, true);
    }
    return bytes;
}

/** With one node that has one mesh, unless change makes something else of the JSON. */
export function glbBytes(triangles, change = () => {}) {
    const json = {
        asset: { version: '2.0' },
        scene: 0,
        scenes: [{ nodes: [0] }],
        nodes: [{ mesh: 0 }],
        buffers: [{ byteLength: triangles.byteLength }],
        meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
        materials: [{}],
        bufferViews: [{ buffer: 0, byteLength: triangles.byteLength }],
        accessors: [
            { bufferView: 0, componentType: 5126, count: triangles.length / 3, type: 'VEC3', min: [-9, -9, -9], max: [9, 9, 9] },
        ],
    };
    change(json);
    const text = JSON.stringify(json).padEnd(4 * Math.ceil(JSON.stringify(json).length / 4));
    const bytes = new Uint8Array(28 + text.length + triangles.byteLength), view = new DataView(bytes.buffer);
    [0x46546c67, 2, bytes.length, text.length, 0x4e4f534a].forEach((word, w) => view.setUint32(4 * w, word, true));
    bytes.set(new TextEncoder().encode(text), 20);
    view.setUint32(20 + text.length, triangles.byteLength, true);
    view.setUint32(24 + text.length, 0x004e4942, true);
    bytes.set(new Uint8Array(triangles.buffer), 28 + text.length);
    return bytes;
}

/** The same triangles in every kind of file: name and path. */
export function everyKind(triangles) {
    const points = corners(triangles).map((point) => point.join(' ')), lists = faces(triangles);
    const obj = [...points.map((p) => `v ${p}`), ...lists.map((face) => `f ${face.map((v) => v + 1).join(' ')}`)];
    const off = ['OFF', `${points.length} ${lists.length} 0`, ...points, ...lists.map((face) => `3 ${face.join(' ')}`)];
    return [
        ['binary.stl', stlBytes(triangles)],
        ['mesh.obj', `${obj.join('\n')}\n`],
        ['binary.ply', plyBytes(triangles)],
        ['mesh.off', `${off.join('\n')}\n`],
        ['mesh.glb', glbBytes(triangles)],
    ].map(([name, content]) => ({ name, path: write(name, content) }));
}

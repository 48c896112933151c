// glb.js - GLB files by three's loader, as the program has libassimp for them: all meshes of the scene, each where it stands.
// Textures are not read.
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Vector3 } from 'three';

/** A BufferGeometry, with or without an index, moved by a matrix if there is one. */
function trianglesOf(geometry, matrix) {
    const position = geometry.getAttribute('position');
    if (!position) return new Float32Array(0);
    const numbers = geometry.index?.array, count = 3 * Math.floor((numbers ? numbers.length : position.count) / 3);
    const triangles = new Float32Array(3 * count),
        point = new Vector3(); // moved here: others share the attribute, and what it holds may be whole numbers
    for (let i = 0; i < count; i++) {
        const vertex = numbers ? numbers[i] : i;
        if (vertex >= position.count)
            throw new Error(
                `face ${Math.floor(i / 3)} refers to vertex ${vertex}, and there are ${position.count}. Export the mesh again.`,
            );
        point.fromBufferAttribute(position, vertex);
        if (matrix) point.applyMatrix4(matrix);
        point.toArray(triangles, 3 * i);
    }
    return triangles;
}

/** All meshes under an object, each where the scene has it. */
function trianglesUnder(object) {
    const parts = [];
    object.updateMatrixWorld(true);
    object.traverse((child) => {
        if (child.isMesh) parts.push(trianglesOf(child.geometry, child.matrixWorld));
    });
    const triangles = new Float32Array(parts.reduce((total, part) => total + part.length, 0));
    let at = 0;
    for (const part of parts) {
        triangles.set(part, at);
        at += part.length;
    }
    return triangles;
}

const MAGIC = 0x46546c67; // glTF

export async function readGlb(file) {
    try {
        const triangles = await trianglesIn(await file.arrayBuffer());
        if (!triangles.length) throw new Error('holds no triangles');
        return { name: file.name, triangles, up: 'y' };
    } catch (error) {
        throw new Error(`${file.name}: ${error.message}`);
    }
}

async function trianglesIn(buffer) {
    if (buffer.byteLength < 20 || new DataView(buffer).getUint32(0, true) !== MAGIC)
        throw new Error('does not begin as a GLB file. Export it as glTF binary.');
    const promised = new DataView(buffer).getUint32(8, true);
    if (promised > buffer.byteLength)
        throw new Error(`promises ${promised} bytes and has ${buffer.byteLength}: the file is cut. Download it again.`);
    const { scene } = await new GLTFLoader().parseAsync(withoutPictures(buffer), '');
    return trianglesUnder(scene);
}

/** The same file without materials, so that nothing is decoded or fetched that is not needed. */
function withoutPictures(buffer) {
    const length = new DataView(buffer).getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
    for (const name of ['materials', 'textures', 'images', 'samplers', 'animations']) delete json[name];
    for (const mesh of json.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;
    const text = new TextEncoder().encode(JSON.stringify(json)), padded = 4 * Math.ceil(text.length / 4);
    const rest = new Uint8Array(buffer, 20 + length), out = new Uint8Array(20 + padded + rest.length).fill(0x20);
    out.set(new Uint8Array(buffer, 0, 20));
    out.set(text, 20);
    out.set(rest, 20 + padded);
    const view = new DataView(out.buffer);
    view.setUint32(8, out.length, true);
    view.setUint32(12, padded, true);
    return out.buffer;
}

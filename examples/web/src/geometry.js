// geometry.js - triangles of nine floats each out of what three's loaders return.
import { Vector3 } from 'three';

/** A BufferGeometry, with or without an index, moved by a matrix if there is one. */
export function trianglesOf(geometry, matrix) {
    const position = geometry.getAttribute('position');
    if (!position) return new Float32Array(0);
    const numbers = geometry.index?.array,
        count = 3 * Math.floor((numbers ? numbers.length : position.count) / 3);
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
export function trianglesUnder(object) {
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

// mesh.mjs - a mesh of doubles or floats in the memory of an instance, as it was given.
import { boxNumbers, isOriented, meshArrays } from './arguments.mjs';
import { Triangles } from './questions.mjs';

const MESH_BYTES = 32;
const kinds = [Float64Array, Float32Array];

export class Mesh extends Triangles {
    #address;
    #positions;

    constructor(memory, mesh) {
        const { positions, indices, vertices, count } = meshArrays(memory, mesh, kinds,
            () => 'give a Float64Array or a Float32Array');
        const bytes = MESH_BYTES + positions.byteLength + (indices?.byteLength ?? 0);
        const room = memory.take(bytes, `a mesh of ${count} triangles`);
        super(memory, [room], 'mesh', 'tribox_mesh_overlap', '_f64');
        const Kind = kinds.find((kind) => positions instanceof kind);
        Object.defineProperty(this, 'length', { value: count, enumerable: true });
        this.#address = room;
        this.#positions = { Kind, at: room + MESH_BYTES, length: positions.length };
        try {
            this.positions.set(positions);
            const at = room + MESH_BYTES + positions.byteLength;
            if (indices)
                new indices.constructor(memory.buffer, at, indices.length).set(indices);
            memory.words(room, MESH_BYTES / 4).set([room + MESH_BYTES, 0, vertices, indices ? at : 0,
                indices?.BYTES_PER_ELEMENT ?? 0, count, Kind.BYTES_PER_ELEMENT, 0]);
        } catch (error) {
            this.free();
            throw error;
        }
    }

    get address() {
        void this.held;
        return this.#address;
    }

    get asked() {
        return [this.#address];
    }

    get positions() {
        const { Kind, at, length } = this.#positions;
        return new Kind(this.held.buffer, at, length);
    }

    writeBox(memory, box) {
        return memory.boxOfDoubles(boxNumbers(box, true));
    }

    prepareAny(box, options, more) {
        if (isOriented(box))
            throw new TypeError('box is oriented, which a mesh does not take: soup() does');
        return { first: this.prepare(box, options, more), suffix: '' };
    }
}

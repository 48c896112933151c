// mesh.mjs - a mesh of doubles or floats in the memory of an instance, as it was given.
import { checkKeys, meshArrays } from './arguments.mjs';
import { Triangles } from './triangles.mjs';

const MESH_BYTES = 56;
const kinds = [Float64Array, Float32Array];

export class Mesh extends Triangles {
    #address;
    #positions;
    #indices;
    #ids;

    constructor(memory, mesh, options) {
        const { positions, indices, vertices, count } = meshArrays(memory, mesh, kinds,
            () => 'give a Float64Array or a Float32Array');
        checkKeys(options, ['sort']);
        const bytes = MESH_BYTES + positions.byteLength + (indices?.byteLength ?? 0);
        const room = memory.take(bytes, `a mesh of ${count} triangles`);
        super(memory, room, 'mesh', 'tribox_mesh_');
        const Kind = kinds.find((kind) => positions instanceof kind);
        Object.defineProperty(this, 'length', { value: count, enumerable: true });
        this.#address = room;
        this.#positions = { Kind, at: room + MESH_BYTES, length: positions.length };
        this.#indices = indices &&
            { Kind: indices.constructor, at: room + MESH_BYTES + positions.byteLength, length: indices.length };
        this.#ids = null;
        try {
            this.positions.set(positions);
            this.indices?.set(indices);
            memory.words(room, MESH_BYTES / 4).fill(0).set([this.#positions.at, 0, vertices, this.#indices?.at ?? 0,
                indices?.BYTES_PER_ELEMENT ?? 0, count, Kind.BYTES_PER_ELEMENT]);
            if (options?.sort)
                this.#sort(memory, indices ?? positions);
        } catch (error) {
            this.free();
            throw error;
        }
    }

    /** Puts near triangles near in number. given: the indices, or without them the positions, as they were. */
    #sort(memory, given) {
        const { length } = this, share = given.length / length;
        this.#ids = memory.borrow(4 * length, 'the order of a mesh', (order) => {
            memory.borrow(16 * length, 'sorting a mesh', (scratch) =>
                memory.call('tribox_mesh_sort', this.#address, order, scratch));
            return memory.words(order, length).slice();
        });
        const sorted = this.indices ?? this.positions;
        this.#ids.forEach((id, i) => {
            for (let k = 0; k < share; k++)
                sorted[share * i + k] = given[share * id + k];
        });
    }

    get address() {
        void this.held;
        return this.#address;
    }

    get isMesh() {
        return true;
    }

    get ids() {
        void this.held;
        return this.#ids;
    }

    #view({ Kind, at, length }) {
        return new Kind(this.held.buffer, at, length);
    }

    get positions() {
        return this.#view(this.#positions);
    }

    get indices() {
        void this.held;
        return this.#indices && this.#view(this.#indices);
    }

    /** A function that writes the nine numbers of triangle i, vertex after vertex. */
    reader() {
        const { positions, indices } = this;
        return (i, nine) => {
            for (let k = 0; k < 9; k++) {
                const corner = 3 * i + ((k / 3) | 0);
                nine[k] = positions[3 * (indices ? indices[corner] : corner) + k % 3];
            }
        };
    }
}

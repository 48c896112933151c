// soup.mjs - triangles as nine streams of floats in the memory of an instance.
import { checkKeys, meshArrays } from './arguments.mjs';
import { Triangles } from './triangles.mjs';

// Streams start on lines of the cache, an odd number of lines apart, so that they do not contend for the same places in it.
const LINE = 64, SOUP_BYTES = 40;
const streamBytes = (length) => 2 * LINE * Math.ceil(4 * length / (2 * LINE)) + LINE;

/** Where the nine streams lie in a room: x of vertices 0, 1, 2, then y, then z. */
function streamsIn(room, length) {
    const start = LINE * Math.ceil((room + SOUP_BYTES) / LINE);
    return Array.from({ length: 9 }, (_, k) => start + k * streamBytes(length));
}

export class Soup extends Triangles {
    #address;
    #streams;
    #ids;

    /** Its streams are not written yet. */
    constructor(memory, length) {
        const room = memory.take(9 * streamBytes(length) + SOUP_BYTES + LINE, `a soup of ${length} triangles`);
        super(memory, room, 'soup', 'tribox_');
        Object.defineProperty(this, 'length', { value: length, writable: false, enumerable: true });
        this.#address = room;
        this.#streams = streamsIn(room, length);
        this.#ids = null;
        memory.words(room, SOUP_BYTES / 4).set([...this.#streams, length]);
    }

    get address() {
        void this.held;
        return this.#address;
    }

    get isMesh() {
        return false;
    }

    get ids() {
        void this.held;
        return this.#ids;
    }

    #axis(a) {
        return [0, 1, 2].map((v) => this.held.floats(this.#streams[3 * a + v], this.length));
    }

    get x() {
        return this.#axis(0);
    }

    get y() {
        return this.#axis(1);
    }

    get z() {
        return this.#axis(2);
    }

    /** The same triangles, those near in space near in number. */
    sorted() {
        const memory = this.held, { length } = this;
        const soup = new Soup(memory, length);
        try {
            soup.#ids = memory.borrow(4 * length, 'the order of a soup', (order) => {
                memory.borrow(16 * length, 'sorting a soup', (scratch) =>
                    memory.call('tribox_soup_sort', this.#address, order, scratch));
                const streams = soup.#address;
                memory.call('tribox_soup_gather', this.#address, order, 0, length, streams, streams + 12, streams + 24);
                return memory.words(order, length).slice();
            });
        } catch (error) {
            soup.free();
            throw error;
        }
        return soup;
    }

    /** A function that writes the nine numbers of triangle i, vertex after vertex. */
    reader() {
        const streams = [0, 1, 2].flatMap((v) => [this.x[v], this.y[v], this.z[v]]);
        return (i, nine) => {
            for (let k = 0; k < 9; k++)
                nine[k] = streams[k][i];
        };
    }
}

function refusePositions(positions) {
    if (positions instanceof Float64Array)
        return 'a soup has floats; mesh() takes doubles as they are, and new Float32Array(positions) rounds them';
    return 'give a Float32Array, such as new Float32Array([x, y, z, x, y, z, ...])';
}

/** Writes x, y and z of every vertex of every triangle to its stream. */
function spread(soup, positions, indices) {
    for (let v = 0; v < 3; v++) {
        const x = soup.x[v], y = soup.y[v], z = soup.z[v];
        for (let i = 0, k = v; i < soup.length; i++, k += 3) {
            const at = 3 * (indices ? indices[k] : k);
            x[i] = positions[at];
            y[i] = positions[at + 1];
            z[i] = positions[at + 2];
        }
    }
}

export function soupOf(memory, mesh, options) {
    const { positions, indices, count } = meshArrays(memory, mesh, [Float32Array], refusePositions);
    checkKeys(options, ['sort']);
    const soup = new Soup(memory, count);
    spread(soup, positions, indices);
    if (!options?.sort)
        return soup;
    try {
        return soup.sorted();
    } finally {
        soup.free();
    }
}

export function soupOfNaN(memory, length) {
    const soup = new Soup(memory, length);
    for (const stream of [...soup.x, ...soup.y, ...soup.z])
        stream.fill(NaN);
    return soup;
}

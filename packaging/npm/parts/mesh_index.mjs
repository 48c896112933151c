// mesh_index.mjs - an index over a soup or a mesh, and what it is asked.
import { axesBits, checkKeys, optionKeys, whole } from './arguments.mjs';
import { shown } from './errors.mjs';
import { maskWords } from './mask.mjs';
import { placeIn, Questions } from './questions.mjs';

const INDEX_BYTES = 32, LINE = 64;

// What classify finds of 64 triangles: which overlap, which lie inside, and the number of the 64. There is room for it from the
// beginning, so that classify takes none.
const FOUND_BYTES = 20;

// The numbers that most lists have room for. Longer ones are asked for twice.
const LIST_ROOM = 1024;

export class Index extends Questions {
    #address;
    #nodes;
    #found;
    #triangles;

    /** triangles: a Soup or a Mesh. */
    constructor(memory, triangles) {
        const { length, address, isMesh } = triangles;
        const bytes = 8 * Math.ceil((memory.exports.tribox_index_bytes(length) >>> 0) / 8), words = maskWords(length) / 2;
        const room = memory.take(INDEX_BYTES + LINE + bytes + FOUND_BYTES * words, `an index of ${length} triangles`);
        super(memory, [room], 'index');
        this.#address = room;
        this.#nodes = LINE * Math.ceil((room + INDEX_BYTES) / LINE);
        this.#found = this.#nodes + bytes;
        this.#triangles = triangles;
        memory.words(room, INDEX_BYTES / 4).fill(0).set([this.#nodes, ...(isMesh ? [0, address] : [address, 0])]);
        memory.call('tribox_index_build', room, 0, this.#nodes);
    }

    get triangles() {
        return this.#triangles;
    }

    get length() {
        return this.#triangles.length;
    }

    /** Throws where the triangles were freed. */
    get address() {
        void this.held;
        void this.#triangles.address;
        return this.#address;
    }

    question(box, options, more) {
        this.#checkAxes(options);
        const question = super.question(box, options, more), { memory } = question;
        return { ...question, first: [question.address, memory.region(question.box, question.isTurned), question.options] };
    }

    overlapInto({ memory, first }, mask) {
        memory.call('tribox_index_overlap', ...first, mask, memory.report);
    }

    #checkAxes(options) {
        if (options?.axes !== undefined && !(axesBits(options.axes) & 1))
            throw new RangeError("options.axes: an index needs 'box' among them; without it ask the soup or the mesh");
    }

    classifyInto({ memory, first }, hit, inside) {
        const words = maskWords(this.length), most = words / 2;
        memory.words(hit, words).fill(0);
        memory.words(inside, words).fill(0);
        const bits = this.#found, insides = bits + 8 * most, numbers = insides + 8 * most;
        memory.call('tribox_index_words', ...first, most, numbers, bits, insides, memory.number, memory.report);
        const found = memory.readNumber(), places = memory.words(numbers, found);
        for (const [to, from] of [[hit, bits], [inside, insides]]) {
            const mask = memory.words(to, words), written = memory.words(from, 2 * found);
            for (let k = 0; k < found; k++) {
                mask[2 * places[k]] = written[2 * k];
                mask[2 * places[k] + 1] = written[2 * k + 1];
            }
        }
    }

    list(box, options) {
        const { ids = false, ...others } = options ?? {};
        checkKeys(options, [...optionKeys, 'ids']);
        const { memory, first } = this.question(box, others), original = ids ? this.#triangles.ids : null;
        const listUpTo = (room) => memory.borrow(4 * room, `a list of ${room} triangles`, (address) => {
            memory.call('tribox_index_list', ...first, room, address, memory.number);
            const found = memory.readNumber();
            return found > room ? found : memory.words(address, found).slice();
        });
        let list = listUpTo(LIST_ROOM);
        list = typeof list === 'number' ? listUpTo(list) : list;
        return original ? list.map((i) => original[i]) : list;
    }

    lists(boxes, options) {
        if (!Array.isArray(boxes))
            throw new TypeError(`boxes = ${shown(boxes)}: give an array of boxes, such as [{lo, hi}, {lo, hi}]`);
        const lists = Array.from(boxes, (box) => this.list(box, options)), starts = new Uint32Array(lists.length + 1);
        lists.forEach((list, n) => {
            starts[n + 1] = starts[n] + list.length;
        });
        const list = new Uint32Array(starts[lists.length]);
        lists.forEach((one, n) => list.set(one, starts[n]));
        return { starts, list };
    }

    any(box, options) {
        const { memory, first } = this.question(box, options);
        memory.call('tribox_index_any', ...first, memory.number);
        return placeIn(memory, this.length);
    }

    update(first = 0, count = this.length - first) {
        const memory = this.held, { address } = this;
        whole(first, 'first', 0, this.length);
        whole(count, 'count', 0, this.length - first, 'so that first + count is within the triangles');
        memory.call('tribox_index_update', address, first, count, 0, this.#nodes);
    }
}

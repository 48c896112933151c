// soup_index.mjs - an index over a soup, and what it is asked.
import { axesBits, checkKeys, optionKeys, whole } from './arguments.mjs';
import { maskWords } from './mask.mjs';
import { placeIn, Questions } from './questions.mjs';

const INDEX_BYTES = 8, LINE = 64;

// What classify finds of 64 triangles: which overlap, which lie inside, and the number of the 64. There is room for it from the
// beginning, so that classify takes none.
const FOUND_BYTES = 20;

// The numbers that most lists have room for. Longer ones are asked for twice.
const LIST_ROOM = 1024;

export class Index extends Questions {
    #address;
    #nodes;
    #found;
    #soup;

    constructor(memory, soup) {
        const bytes = 8 * Math.ceil((memory.exports.tribox_index_bytes(soup.length) >>> 0) / 8), words = maskWords(soup.length) / 2;
        const room = memory.take(INDEX_BYTES + LINE + bytes + FOUND_BYTES * words, `an index of ${soup.length} triangles`);
        super(memory, [room], 'index', 'tribox_index_overlap');
        this.#address = room;
        this.#nodes = LINE * Math.ceil((room + INDEX_BYTES) / LINE);
        this.#found = this.#nodes + bytes;
        this.#soup = soup;
        memory.call('tribox_index_build', soup.address, 0, this.#nodes, this.#address);
    }

    get soup() {
        return this.#soup;
    }

    get length() {
        return this.#soup.length;
    }

    /** Throws where the soup was freed. */
    get asked() {
        return [this.#address, this.#soup.address];
    }

    prepare(box, options, more) {
        this.#checkAxes(options);
        return super.prepare(box, options, more);
    }

    prepareAny(box, options, more) {
        this.#checkAxes(options);
        return super.prepareAny(box, options, more);
    }

    #checkAxes(options) {
        if (options?.axes !== undefined && !(axesBits(options.axes) & 1))
            throw new RangeError("options.axes: an index needs 'box' among them; without it ask the soup");
    }

    classifyInto(memory, first, hit, inside) {
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
        const memory = this.held, original = ids ? this.#soup.ids : null;
        checkKeys(options, [...optionKeys, 'ids']);
        const { first, suffix } = this.prepareAny(box, others, []);
        const listUpTo = (room) => memory.borrow(4 * room, `a list of ${room} triangles`, (address) => {
            memory.call(`tribox_index_list${suffix}`, ...first, 0, room, address, memory.number);
            const found = memory.readNumber();
            return found > room ? found : memory.words(address, found).slice();
        });
        let list = listUpTo(LIST_ROOM);
        list = typeof list === 'number' ? listUpTo(list) : list;
        return original ? list.map((i) => original[i]) : list;
    }

    any(box, options) {
        const memory = this.held;
        memory.call('tribox_index_any', ...this.prepare(box, options), memory.number);
        return placeIn(memory, this.length);
    }

    update(first = 0, count = this.length - first) {
        whole(first, 'first', 0, this.length);
        whole(count, 'count', 0, this.length - first, 'so that first + count is within the soup');
        this.held.call('tribox_index_update', this.#soup.address, first, count, 0, this.#nodes);
    }
}

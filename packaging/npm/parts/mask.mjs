// mask.mjs - a bit for each triangle: a caller's own, or in the memory of an instance.
import { Held } from './held.mjs';
import { whole } from './arguments.mjs';

export function countBits(words) {
    let count = 0;
    for (let word of words) {
        word -= (word >>> 1) & 0x55555555;
        word = (word & 0x33333333) + ((word >>> 2) & 0x33333333);
        count += Math.imul((word + (word >>> 4)) & 0x0f0f0f0f, 0x01010101) >>> 24;
    }
    return count;
}

/** Calls take(32 * place + bit) for each bit that is set. */
export function forEachBit(words, take) {
    for (let place = 0; place < words.length; place++)
        for (let word = words[place]; word; word &= word - 1)
            take(32 * place + 31 - Math.clz32(word & -word));
}

/** The 32-bit words of so many bits: whole words of 64. */
export const maskWords = (bits) => 2 * Math.ceil(bits / 64);

/** Words that are a caller's own, or lie at an address of a memory. */
export class Words extends Held {
    #memory;
    #address;
    #length;
    #own;

    constructor(memory, address, length, own, name) {
        super(memory, own ? [] : [address], name);
        this.#memory = memory;
        this.#address = address;
        this.#length = length;
        this.#own = own;
    }

    get view() {
        void this.held;
        return this.#own ?? this.#memory.words(this.#address, this.#length);
    }

    /** The address, for a call on that memory that is to write there. */
    addressFor(memory, name) {
        if (!this.isIn(memory))
            throw new TypeError(`${name} is not in the memory of this instance: make it with its mask() or voxels()`);
        return this.#address;
    }

    count() {
        return countBits(this.view);
    }

    free() {
        super.free();
        this.#own = undefined;
    }
}

export class Mask extends Words {
    #length;

    /** own: the words, unless they lie at the address. */
    constructor(memory, address, length, own) {
        super(memory, address, maskWords(length), own, 'mask');
        this.#length = length;
    }

    get length() {
        return this.#length;
    }

    get words() {
        return this.view;
    }

    has(i) {
        whole(i, 'i', 0, this.#length - 1);
        return (this.view[i >>> 5] >>> (i & 31) & 1) === 1;
    }

    list() {
        const words = this.view, list = new Uint32Array(countBits(words));
        let found = 0;
        forEachBit(words, (i) => {
            list[found++] = i;
        });
        return list;
    }
}

/** The mask to write: the caller's, or room that is copied from and given back. Returns what work(address) does and the mask. */
export function withMask(memory, length, into, name, work) {
    if (into !== undefined) {
        if (!(into instanceof Mask))
            throw new TypeError(`options.${name}: give a mask that tribox.mask(${length}) made`);
        if (into.length !== length)
            throw new RangeError(`options.${name} has ${into.length} bits: give one of ${length}, for as many triangles`);
        return { mask: into, result: work(into.addressFor(memory, `options.${name}`)) };
    }
    const words = maskWords(length);
    return memory.borrow(4 * words, `a mask of ${length} bits`, (address) => {
        const result = work(address);
        return { mask: new Mask(memory, 0, length, memory.words(address, words).slice()), result };
    });
}

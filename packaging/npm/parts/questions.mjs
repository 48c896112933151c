// questions.mjs - what soups, indices and meshes are asked alike: which triangles overlap a box, how many, the first.
import { axesBits, boxNumbers, checkKeys, isOriented, optionKeys, orientedBoxNumbers } from './arguments.mjs';
import { Held } from './held.mjs';
import { countBits, withMask } from './mask.mjs';

/** A place that a call wrote; -1 if it is past the last. */
export function placeIn(memory, length) {
    const place = memory.readNumber();
    return place === length ? -1 : place;
}

/** The rounded frame of an oriented box leaves the directions of its other axes open. */
function checkOrientedAxes(options) {
    if ((options?.accuracy ?? 'exact') === 'exact' && ![0, 1, 7].includes(axesBits(options?.axes)))
        throw new RangeError("options.axes: an oriented box takes all groups or ['box'] where the accuracy is exact");
}

/** Which triangles overlap, and how many. A subclass has `length` and `asked`: the addresses that its calls begin with. */
export class Questions extends Held {
    #overlap;

    /** overlap: the call. */
    constructor(memory, rooms, name, overlap) {
        super(memory, rooms, name);
        this.#overlap = overlap;
    }

    /** Writes box and options for a call, and returns its first arguments. more: options that it takes besides those of all. */
    prepare(box, options, more = []) {
        const memory = this.held;
        checkKeys(options, [...optionKeys, ...more]);
        return [...this.asked, this.writeBox(memory, box), memory.options(options)];
    }

    /** Writes the box of a call that takes one with axes of the world. */
    writeBox(memory, box) {
        if (isOriented(box))
            throw new TypeError('box is oriented, which this call does not take: give {lo, hi}');
        return memory.box(boxNumbers(box));
    }

    /** The same for calls that take either, and what the name of the call for oriented ones ends in. */
    prepareAny(box, options, more) {
        if (!isOriented(box))
            return { first: this.prepare(box, options, more), suffix: '' };
        const memory = this.held;
        checkKeys(options, [...optionKeys, ...more]);
        checkOrientedAxes(options);
        const address = memory.box(orientedBoxNumbers(box));
        return { first: [...this.asked, address, memory.options(options)], suffix: '_oriented' };
    }

    overlap(box, options) {
        const memory = this.held, { first, suffix } = this.prepareAny(box, options, ['into']);
        const { mask } = withMask(memory, this.length, options?.into, 'into', (address) =>
            memory.call(this.#overlap + suffix, ...first, address, memory.report));
        return { ...memory.readReport(), mask };
    }

    count(box, options) {
        const memory = this.held, { first, suffix } = this.prepareAny(box, options, []);
        memory.call(this.#overlap + suffix, ...first, 0, memory.report);
        return memory.readReport().overlapping;
    }

    classify(box, options) {
        const memory = this.held, first = this.prepare(box, options, ['into', 'insideInto']), length = this.length;
        if (options?.into && options.into === options.insideInto)
            throw new TypeError('options.insideInto is the mask of options.into: give another');
        const { mask, result } = withMask(memory, length, options?.into, 'into', (hit) =>
            withMask(memory, length, options?.insideInto, 'insideInto', (inside) => this.classifyInto(memory, first, hit, inside)));
        const insideMask = result.mask;
        return { ...memory.readReport(), inside: countBits(insideMask.words), mask, insideMask };
    }
}

/** What soups and meshes are asked besides. */
export class Triangles extends Questions {
    #suffix;

    /** suffix: what the names of the calls end in. */
    constructor(memory, rooms, name, overlap, suffix) {
        super(memory, rooms, name, overlap);
        this.#suffix = suffix;
    }

    classifyInto(memory, first, hit, inside) {
        memory.call(`tribox_classify${this.#suffix}`, ...first, hit, inside, memory.report);
    }

    /** what: TRIBOX_FIRST_HIT or TRIBOX_FIRST_MISS. */
    find(memory, first, what) {
        memory.call(this.#suffix ? 'tribox_mesh_find' : 'tribox_find', ...first, what, memory.number);
    }

    first(box, options) {
        const memory = this.held, first = this.prepare(box, options);
        this.find(memory, first, 0);
        return placeIn(memory, this.length);
    }

    firstMiss(box, options) {
        const memory = this.held, first = this.prepare(box, options);
        this.find(memory, first, 1);
        return placeIn(memory, this.length);
    }
}

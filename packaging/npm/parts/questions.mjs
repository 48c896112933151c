// questions.mjs - what soups, meshes and indices are asked alike: which triangles overlap a box, how many, which are inside.
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

/**
 * Which triangles overlap, and how many. A subclass has `length` and `address`, and writes answers to masks: overlapInto(question,
 * mask) and classifyInto(question, mask, inside).
 */
export class Questions extends Held {
    /** Writes box and options for a call that takes either kind of box. more: options that it takes besides those of all. */
    question(box, options, more = []) {
        const memory = this.held, { address } = this, isTurned = isOriented(box);
        checkKeys(options, [...optionKeys, ...more]);
        if (isTurned)
            checkOrientedAxes(options);
        const at = memory.box(isTurned ? orientedBoxNumbers(box) : boxNumbers(box));
        return { memory, address, box: at, isTurned, options: memory.options(options) };
    }

    /** The same for a call that takes no oriented box. */
    uprightQuestion(box, options, more) {
        void this.address;
        if (isOriented(box))
            throw new TypeError('box is oriented, which this call does not take: give {lo, hi}');
        return this.question(box, options, more);
    }

    overlap(box, options) {
        const question = this.question(box, options, ['into']), { memory } = question;
        const { mask } = withMask(memory, this.length, options?.into, 'into', (address) => this.overlapInto(question, address));
        return { ...memory.readReport(), mask };
    }

    count(box, options) {
        const question = this.question(box, options);
        this.overlapInto(question, 0);
        return question.memory.readReport().overlapping;
    }

    classify(box, options) {
        const question = this.uprightQuestion(box, options, ['into', 'insideInto']), { memory } = question, { length } = this;
        if (options?.into && options.into === options.insideInto)
            throw new TypeError('options.insideInto is the mask of options.into: give another');
        const { mask, result } = withMask(memory, length, options?.into, 'into', (hit) =>
            withMask(memory, length, options?.insideInto, 'insideInto', (inside) => this.classifyInto(question, hit, inside)));
        const insideMask = result.mask;
        return { ...memory.readReport(), inside: countBits(insideMask.words), mask, insideMask };
    }
}

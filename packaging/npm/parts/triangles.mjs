// triangles.mjs - what soups and meshes are asked and make alike, but for the names of the calls.
import { axesBits, boxNumbers, finite, oneOf, whole } from './arguments.mjs';
import { bricks, tileLists } from './bricks.mjs';
import { shown } from './errors.mjs';
import { boundsOf } from './grid.mjs';
import { Index } from './mesh_index.mjs';
import { placeIn, Questions } from './questions.mjs';
import { cellLists, fillParity, voxelize } from './voxels.mjs';

const whats = ['hit', 'miss'];

/** A copy of the numbers of triangles. */
function triangleNumbers(list, length) {
    if (typeof list?.length !== 'number' || typeof list === 'string')
        throw new TypeError(`options.list = ${shown(list)}: give the numbers of triangles`);
    return Uint32Array.from(list, (number, i) => whole(number, `options.list[${i}]`, 0, length - 1));
}

/** Where the children of a box meet: not outside it, unless it is empty. */
function middleOf(box, middle) {
    const numbers = boxNumbers(box), three = finite(middle, 'options.middle'),
        isEmpty = three.some((_, a) => numbers[a] > numbers[a + 3]);
    if (!isEmpty && three.some((number, a) => number < numbers[a] || number > numbers[a + 3]))
        throw new RangeError(`options.middle = ${shown(three)} is outside the box`);
    return three;
}

/** A subclass has address, length, ids and reader(). */
export class Triangles extends Questions {
    #prefix;

    /** prefix: what the names of the calls begin with. */
    constructor(memory, room, name, prefix) {
        super(memory, [room], name);
        this.#prefix = prefix;
    }

    /** Makes a call of this kind of triangles. */
    call(memory, name, ...numbers) {
        memory.call(this.#prefix + name, this.address, ...numbers);
    }

    overlapInto({ memory, box, isTurned, options }, mask) {
        this.call(memory, isTurned ? 'overlap_oriented' : 'overlap', box, options, mask, memory.report);
    }

    classifyInto({ memory, box, options }, mask, inside) {
        this.call(memory, 'classify', box, options, mask, inside, memory.report);
    }

    find(box, options) {
        const { memory, box: at, options: address } = this.uprightQuestion(box, options, ['what']);
        this.call(memory, 'find', at, address, whats.indexOf(oneOf(options?.what ?? 'hit', 'options.what', whats)), memory.number);
        return placeIn(memory, this.length);
    }

    split(box, options) {
        const { memory, box: at, options: address } = this.uprightQuestion(box, options, ['middle', 'list']);
        if (![0, 1, 7].includes(axesBits(options?.axes)))
            throw new RangeError("options.axes: children take all groups or ['box']");
        const list = options?.list && triangleNumbers(options.list, this.length), count = list?.length ?? this.length;
        const middle = options?.middle && middleOf(box, options.middle);
        return memory.borrow(24 + 5 * count, `children of ${count} triangles`, (room) => {
            const from = room + 24, children = from + 4 * count;
            memory.doubles(room, 3).set(middle ?? []);
            memory.words(from, count).set(list ?? []);
            this.call(memory, 'split', list ? from : 0, count, at, middle ? room : 0, address, children, 0);
            return new Uint8Array(memory.buffer, children, count).slice();
        });
    }

    voxelize(grid, options) {
        return voxelize(this.held, this, grid, options);
    }

    fillParity(voxels) {
        return fillParity(this.held, this, voxels);
    }

    tileLists(grid, tiles, options) {
        return tileLists(this.held, this, grid, tiles, options);
    }

    cellLists(grid, options) {
        return cellLists(this.held, this, grid, options);
    }

    bricks(grid, tiles, take, options) {
        return bricks(this.held, this, grid, tiles, take, options);
    }

    index() {
        return new Index(this.held, this);
    }

    bounds() {
        void this.held;
        return boundsOf(this.reader(), this.length);
    }
}

// voxels.mjs - the cells of a grid that triangles overlap, a bit each, and what they enclose.
import { checkKeys, optionKeys, whole } from './arguments.mjs';
import { checkGrid, gridFor, readGrid, windowFor } from './grid.mjs';
import { forEachBit, Words } from './mask.mjs';
import { shown } from './errors.mjs';

const rowWordsOf = (size) => 2 * Math.ceil(size[0] / 64);
const wordsOf = (size) => rowWordsOf(size) * size[1] * size[2];
const cellsOf = ({ size }) => size[0] * size[1] * size[2];
const cellsIn = ({ size }) => `${size.join(' x ')} cells`;
const isSame = (one, other, keys) => keys.every((key) => one[key].every((number, a) => number === other[key][a]));

export class Voxels extends Words {
    #grid;
    #window;
    #ids;

    /** own: the words, unless they lie at the address. */
    constructor(memory, address, grid, window, own, ids = null) {
        super(memory, address, wordsOf(window.size), own, 'set of voxels');
        this.#grid = grid;
        this.#window = window;
        this.#ids = ids;
    }

    get grid() {
        return this.#grid;
    }

    get window() {
        return this.#window;
    }

    get size() {
        return this.#window.size;
    }

    get rowWords() {
        return rowWordsOf(this.size);
    }

    get bits() {
        return this.view;
    }

    get ids() {
        void this.held;
        return this.#ids;
    }

    #check(...at) {
        at.forEach((number, a) => whole(number, 'ijk'[a], 0, this.size[a] - 1));
        return at;
    }

    has(i, j, k) {
        this.#check(i, j, k);
        return (this.view[(k * this.size[1] + j) * this.rowWords + (i >>> 5)] >>> (i & 31) & 1) === 1;
    }

    box(i, j, k) {
        return this.held.cellBox(this.#grid, this.#check(i, j, k).map((number, a) => number + this.#window.first[a]));
    }

    list() {
        const list = new Uint32Array(3 * this.count()), row = this.rowWords, rows = this.size[1], bits = this.view;
        let found = 0;
        for (let start = 0, at = 0; start < bits.length; start += row, at++)
            forEachBit(bits.subarray(start, start + row), (i) => {
                list[found++] = i;
                list[found++] = at % rows;
                list[found++] = Math.floor(at / rows);
            });
        return list;
    }

    fillOutside() {
        const memory = this.held;
        return fill(memory, this, ({ occupied, scratch, solid }) => memory.call('tribox_fill_outside',
            memory.window({ first: this.size, size: this.size }), occupied, scratch, solid, memory.number));
    }
}

/** Cells in the memory, all clear. */
export function voxelsIn(memory, numbers, asked) {
    const grid = readGrid(numbers), window = windowFor(grid, asked), words = wordsOf(window.size);
    checkGrid(memory, grid);
    const address = memory.take(4 * words, `a grid of ${cellsIn(window)}`);
    memory.words(address, words).fill(0);
    return new Voxels(memory, address, grid, window);
}

function checkInto(into, grid, window) {
    if (!(into instanceof Voxels))
        throw new TypeError('options.into: give voxels that tribox.voxels(grid) made');
    if (!isSame(into.grid, grid, ['origin', 'cell', 'size']) || !isSame(into.window, window, ['first', 'size']))
        throw new RangeError('options.into has another grid or window: give this call those that it was made with, or itself');
}

/** The grid and window that a call is about: a caller's, or those of voxels. */
export function placeFor(memory, triangles, numbers, asked) {
    if (numbers instanceof Voxels && asked === undefined)
        return { grid: numbers.grid, window: numbers.window };
    const grid = gridFor(memory, triangles, numbers instanceof Voxels ? numbers.grid : numbers);
    return { grid, window: windowFor(grid, asked) };
}

function voxelizeWithIds(memory, triangles, { grid, window, options }) {
    const words = wordsOf(window.size), cells = cellsOf(window);
    return memory.borrow(4 * (words + cells), `the ids of ${cellsIn(window)}`, (address) => {
        const ids = address + 4 * words;
        memory.words(address, words).fill(0);
        memory.words(ids, cells).fill(2 ** 32 - 1);
        triangles.call(memory, 'voxelize_ids', 0, memory.grid(grid), memory.window(window), memory.options(options), address, ids,
            0);
        return new Voxels(memory, 0, grid, window, memory.words(address, words).slice(), memory.words(ids, cells).slice());
    });
}

/** Of the cells that have triangles: where each is, and in the list where its triangles begin. */
function joinCells({ size }, starts, list) {
    const count = starts.reduce((cells, start, c) => cells + (c > 0 && start > starts[c - 1]), 0);
    const cells = new Uint32Array(3 * count), begins = new Uint32Array(count + 1);
    let found = 0;
    for (let c = 0; c + 1 < starts.length; c++)
        if (starts[c] < starts[c + 1]) {
            const row = Math.floor(c / size[0]);
            cells.set([c % size[0], row % size[1], Math.floor(row / size[1])], 3 * found);
            begins[++found] = starts[c + 1];
        }
    return { cells, starts: begins, list };
}

export function cellLists(memory, triangles, numbers, options) {
    checkKeys(options, [...optionKeys, 'window']);
    void triangles.address;
    const { grid, window } = placeFor(memory, triangles, numbers, options?.window), count = cellsOf(window);
    checkGrid(memory, grid);
    return memory.borrow(4 * (count + 1), `lists of ${cellsIn(window)}`, (starts) => {
        const list = (to) => triangles.call(memory, 'cell_lists', memory.grid(grid), memory.window(window), memory.options(options),
            starts, to);
        list(0);
        const places = memory.words(starts, count + 1)[count];
        return memory.borrow(4 * places, `lists of ${places} triangles`, (to) => {
            list(to);
            return { grid, window, ...joinCells(window, memory.words(starts, count + 1), memory.words(to, places).slice()) };
        });
    });
}

export function voxelize(memory, triangles, numbers, options) {
    checkKeys(options, [...optionKeys, 'into', 'window', 'ids', 'thin']);
    void triangles.address;
    const { into } = options ?? {}, { grid, window } = placeFor(memory, triangles, numbers, options?.window);
    const work = (address) => {
        const about = [memory.grid(grid), memory.window(window), memory.options(options), address, 0];
        if (options?.thin)
            triangles.call(memory, 'voxelize_thin', ...about);
        else
            triangles.call(memory, 'voxelize', ...about);
    };
    if (into !== undefined && options.ids)
        throw new TypeError('options.ids and options.into exclude each other: ids are of new voxels');
    if (options?.thin && options.ids)
        throw new TypeError('options.ids and options.thin exclude each other: ids are of all triangles that overlap a cell');
    if (into !== undefined) {
        checkInto(into, grid, window);
        work(into.addressFor(memory, 'options.into'));
        return into;
    }
    checkGrid(memory, grid);
    if (options?.ids)
        return voxelizeWithIds(memory, triangles, { grid, window, options });
    const words = wordsOf(window.size);
    return memory.borrow(4 * words, `a grid of ${cellsIn(window)}`, (address) => {
        memory.words(address, words).fill(0);
        work(address);
        return new Voxels(memory, 0, grid, window, memory.words(address, words).slice());
    });
}

/** The cells that work fills, which is told where the words lie. */
function fill(memory, { bits, grid, window }, work) {
    const { length } = bits, bytes = 4 * length, own = bits.buffer === memory.buffer ? bits.slice() : bits;
    if (!length)
        return { solid: new Voxels(memory, 0, grid, window, own.slice()), inside: 0 };
    const more = memory.exports.tribox_fill_bytes(memory.window({ first: window.size, size: window.size })) >>> 0;
    return memory.borrow(2 * bytes + more, `filling ${cellsIn(window)}`, (occupied) => {
        const solid = occupied + bytes;
        memory.words(occupied, length).set(own);
        work({ occupied, solid, scratch: solid + bytes });
        return { solid: new Voxels(memory, 0, grid, window, memory.words(solid, length).slice()), inside: memory.readNumber() };
    });
}

export function fillParity(memory, triangles, voxels) {
    if (!(voxels instanceof Voxels))
        throw new TypeError(`voxels = ${shown(voxels)}: give those that voxelize made`);
    const { grid, window } = voxels;
    if (!isSame(grid, window, ['size']))
        throw new RangeError('voxels are of a window: give those of a whole grid');
    const filled = fill(memory, voxels, ({ occupied, scratch, solid }) => triangles.call(memory, 'fill_parity', memory.grid(grid),
        occupied, scratch, solid, memory.number, memory.number + 4));
    return { ...filled, oddRows: memory.readNumber(1) };
}

// voxels.mjs - the cells of a grid that triangles overlap, a bit each.
import { checkKeys, optionKeys, whole } from './arguments.mjs';
import { cellBox, gridFor, readGrid } from './grid.mjs';
import { forEachBit, Words } from './mask.mjs';
import { shown } from './errors.mjs';

const rowWordsOf = (size) => 2 * Math.ceil(size[0] / 64);
const wordsOf = ({ size }) => rowWordsOf(size) * size[1] * size[2];

export class Voxels extends Words {
    #grid;

    /** own: the words, unless they lie at the address. */
    constructor(memory, address, grid, own) {
        super(memory, address, wordsOf(grid), own, 'set of voxels');
        this.#grid = grid;
    }

    get origin() {
        return this.#grid.origin;
    }

    get cell() {
        return this.#grid.cell;
    }

    get size() {
        return this.#grid.size;
    }

    get rowWords() {
        return rowWordsOf(this.size);
    }

    get bits() {
        return this.view;
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
        return cellBox(this.#grid, this.#check(i, j, k));
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
}

/** Has the library refuse grids that it does not serve, before there is room for their cells. */
function checkGrid(memory, grid) {
    const isServed = !memory.exports.tribox_voxelize_layers(memory.emptySoup, memory.grid(grid), 0, 0, 0, memory.number, 0);
    if (!isServed)
        throw new RangeError(`grid: floats cannot tell its planes apart, or it ends beyond the largest float (origin ${
            shown(grid.origin)}, cell ${shown(grid.cell)}, size ${shown(grid.size)}); choose larger cells, or move the mesh towards 0`);
}

/** Cells in the memory, all clear. */
export function voxelsIn(memory, numbers) {
    const grid = readGrid(numbers);
    checkGrid(memory, grid);
    const address = memory.take(4 * wordsOf(grid), `a grid of ${grid.size.join(' x ')} cells`);
    memory.words(address, wordsOf(grid)).fill(0);
    return new Voxels(memory, address, grid);
}

const isSame = (one, other) => ['origin', 'cell', 'size'].every((key) => one[key].every((number, a) => number === other[key][a]));

function checkInto(into, grid) {
    if (!(into instanceof Voxels))
        throw new TypeError('options.into: give voxels that tribox.voxels(grid) made');
    if (!isSame(into, grid))
        throw new RangeError('options.into has another grid: give this call the grid that it was made with, or itself');
}

export function voxelize(memory, soup, numbers, options) {
    checkKeys(options, [...optionKeys, 'into']);
    const grid = gridFor(soup, numbers), { into } = options ?? {};
    const work = (address) => memory.call('tribox_voxelize', soup.address, memory.grid(grid), memory.options(options), address, 0);
    if (into !== undefined) {
        checkInto(into, grid);
        work(into.addressFor(memory, 'options.into'));
        return into;
    }
    checkGrid(memory, grid);
    const words = wordsOf(grid);
    return memory.borrow(4 * words, `a grid of ${grid.size.join(' x ')} cells`, (address) => {
        memory.words(address, words).fill(0);
        work(address);
        return new Voxels(memory, 0, grid, memory.words(address, words).slice());
    });
}

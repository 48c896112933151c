// grid.mjs - grids of cells: as callers write them, and around triangles, as the program tribox lays them.
import { boxNumbers, finite, isObject, vector, whole } from './arguments.mjs';
import { shown } from './errors.mjs';

const SIZE_MAX = 2 ** 32 - 1;

/** The bounds of the triangles whose coordinates are finite; null if there are none. read(i, nine) writes those of triangle i. */
export function boundsOf(read, length) {
    const lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity], nine = new Float64Array(9);
    for (let i = 0; i < length; i++) {
        read(i, nine);
        // Zero times a number is NaN if that is NaN or infinite.
        let zero = 0;
        for (let k = 0; k < 9; k++)
            zero += 0 * nine[k];
        if (zero !== 0)
            continue;
        for (let k = 0; k < 9; k++) {
            const number = nine[k], a = k % 3;
            if (number < lo[a])
                lo[a] = number;
            if (number > hi[a])
                hi[a] = number;
        }
    }
    return lo[0] <= hi[0] ? { lo, hi } : null;
}

/** Plane p of an axis, as the library rounds it. */
const plane = (memory, origin, cell, p) =>
    memory.cellBox({ origin: [origin, 0, 0], cell: [cell, 1, 1], size: [SIZE_MAX, 1, 1] }, [p, 0, 0]).lo[0];

/** The next greater double of a positive one. */
function next(number) {
    const one = new Float64Array([number]);
    new BigUint64Array(one.buffer)[0]++;
    return one[0];
}

/** (end - origin) / step, where the difference alone may overflow. */
const steps = (origin, end, step) => (Number.isFinite(end - origin) ? (end - origin) / step : end / step - origin / step);

/** The least cell with which so many of them reach the end. */
function cellReaching(memory, origin, cells, end) {
    let cell = steps(origin, end, cells);
    while (plane(memory, origin, cell, cells) < end)
        cell = next(cell);
    return cell;
}

/** The least number of cells that reach the end, at least one. */
function cellsReaching(memory, origin, cell, end) {
    let cells = Math.max(1, Math.floor(steps(origin, end, cell)) - 1);
    if (!(cells < SIZE_MAX - 4))
        throw new RangeError(`grid: it would have more than 2^32 cells of ${cell} along an axis: give larger cells`);
    while (plane(memory, origin, cell, cells) < end)
        cells++;
    return cells;
}

function cubesFor(memory, { lo, hi }, resolution) {
    whole(resolution, 'grid.resolution', 1, 2 ** 31 - 1, 'the cells along the longest side');
    const sides = lo.map((start, a) => hi[a] - start), longest = sides.indexOf(Math.max(...sides));
    if (!sides[longest])
        throw new RangeError(`all triangles lie in the point ${shown(lo)}, which has no longest side: give {origin, cell, size}`);
    const cell = cellReaching(memory, lo[longest], resolution, hi[longest]);
    return [cell, cell, cell];
}

function readCell(cell) {
    const three = finite(typeof cell === 'number' ? [cell, cell, cell] : cell, 'grid.cell');
    if (!three.every((length) => length > 0))
        throw new RangeError(`grid.cell = ${shown(cell)}: give lengths greater than 0`);
    return three;
}

/** Of given {resolution} or {cell}, around bounds. */
export function gridAround(memory, bounds, given) {
    const way = 'resolution' in given ? 'resolution' : 'cell', other = Object.keys(given).find((key) => key !== way);
    if (other)
        throw new TypeError(`grid.${other} does not go with ${way}: give {resolution}, {cell}, or {origin, cell, size}`);
    const cell = way === 'resolution' ? cubesFor(memory, bounds, given.resolution) : readCell(given.cell);
    return { origin: bounds.lo, cell, size: bounds.lo.map((start, a) => cellsReaching(memory, start, cell[a], bounds.hi[a])) };
}

/** The numbers of a grid {origin, cell, size}. Leaves open whether the library serves it. */
export function readGrid(grid) {
    if (!isObject(grid) || !('cell' in grid))
        throw new TypeError(`grid = ${shown(grid)}: give {resolution}, {cell}, or {origin, cell, size}`);
    const cell = readCell(grid.cell), size = vector(grid.size, 'grid.size');
    size.forEach((cells, a) => whole(cells, `grid.size[${a}]`, 1, SIZE_MAX));
    return { origin: finite(grid.origin, 'grid.origin'), cell, size };
}

const isAround = (grid) => isObject(grid) && ('resolution' in grid || ('cell' in grid && !('origin' in grid) && !('size' in grid)));

/** The grid around a box. */
export function gridAroundBox(memory, box, given) {
    if (!isAround(given))
        throw new TypeError(`grid = ${shown(given)}: give {resolution} or {cell}`);
    const numbers = boxNumbers(box);
    return gridAround(memory, { lo: numbers.slice(0, 3), hi: numbers.slice(3) }, given);
}

/** The grid that a caller gives, or asks for around triangles. */
export function gridFor(memory, triangles, grid) {
    if (!isAround(grid))
        return readGrid(grid);
    const bounds = triangles.bounds();
    if (!bounds)
        throw new RangeError('there is no triangle with finite coordinates to lay a grid around: give {origin, cell, size}');
    return gridAround(memory, bounds, grid);
}

/** The cells of a grid that are asked for; all of them if the caller names none. */
export function windowFor({ size }, window) {
    if (window === undefined)
        return { first: [0, 0, 0], size };
    if (!isObject(window))
        throw new TypeError(`window = ${shown(window)}: give {first: [i, j, k], size: [ni, nj, nk]}`);
    const first = vector(window.first, 'window.first'), asked = vector(window.size, 'window.size');
    first.forEach((cell, a) => {
        whole(cell, `window.first[${a}]`, 0, size[a]);
        whole(asked[a], `window.size[${a}]`, 0, size[a] - cell, 'so that it is within the grid');
    });
    return { first, size: asked };
}

/** Has the library refuse grids that it does not serve, before there is room for their cells. */
export function checkGrid(memory, grid) {
    const none = memory.window({ first: [0, 0, 0], size: [0, 0, 0] });
    if (memory.exports.tribox_voxelize(memory.emptySoup, memory.grid(grid), none, 0, memory.number, 0))
        throw new RangeError(`grid: doubles cannot tell its planes apart, or it ends beyond the largest of them (origin ${
            shown(grid.origin)}, cell ${shown(grid.cell)}, size ${
            shown(grid.size)}); choose larger cells, or move the mesh towards 0`);
}

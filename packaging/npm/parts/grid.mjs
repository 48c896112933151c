// grid.mjs - grids of cells: as callers write them, and around triangles, as the program tribox lays them.
import { finite, vector, whole } from './arguments.mjs';
import { shown } from './errors.mjs';

const SIZE_MAX = 2 ** 32 - 1;
const float = Math.fround;

/** The bounds of the triangles in x[v][i], y[v][i], z[v][i] whose coordinates are finite; null if there are none. */
export function boundsOf(axes, length) {
    const lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity], streams = axes.flat();
    for (let i = 0; i < length; i++) {
        // Zero times a number is NaN if that is NaN or infinite.
        let zero = 0;
        for (let k = 0; k < 9; k++)
            zero += 0 * streams[k][i];
        if (zero !== 0)
            continue;
        for (let k = 0; k < 9; k++) {
            const number = streams[k][i], a = (k / 3) | 0;
            if (number < lo[a])
                lo[a] = number;
            if (number > hi[a])
                hi[a] = number;
        }
    }
    return lo[0] <= hi[0] ? { lo, hi } : null;
}

const plane = (origin, number, cell) => float(origin + number * cell);

/** The next greater float of a positive one. */
function next(number) {
    const one = new Float32Array([number]);
    new Uint32Array(one.buffer)[0]++;
    return one[0];
}

/** The least cell with which so many of them reach the end. */
function cellReaching(origin, cells, end) {
    let cell = float((end - origin) / cells);
    while (plane(origin, cells, cell) < end)
        cell = next(cell);
    return cell;
}

/** The least number of cells that reach the end, at least one. */
function cellsReaching(origin, cell, end) {
    let cells = Math.max(1, Math.floor((end - origin) / cell) - 1);
    while (plane(origin, cells, cell) < end)
        cells++;
    return cells;
}

function gridAround(soup, resolution) {
    const bounds = soup.bounds();
    whole(resolution, 'grid.resolution', 1, 2 ** 31 - 1, 'the cells along the longest side');
    if (!bounds)
        throw new RangeError('the soup has no triangle with finite coordinates to lay a grid around: give {origin, cell, size}');
    const { lo, hi } = bounds, sides = lo.map((start, a) => hi[a] - start), longest = sides.indexOf(Math.max(...sides));
    if (!sides[longest])
        throw new RangeError(`all triangles lie in the point ${shown(lo)}, which has no longest side: give {origin, cell, size}`);
    const cell = cellReaching(lo[longest], resolution, hi[longest]);
    return { origin: lo, cell: [cell, cell, cell], size: lo.map((start, a) => cellsReaching(start, cell, hi[a])) };
}

/** The numbers of a grid {origin, cell, size}. Leaves open whether the library serves it. */
export function readGrid(grid) {
    if (typeof grid !== 'object' || grid === null)
        throw new TypeError(`grid = ${shown(grid)}: give {resolution}, or {origin, cell, size}`);
    const cell = finite(typeof grid.cell === 'number' ? [grid.cell, grid.cell, grid.cell] : grid.cell, 'grid.cell');
    if (!cell.every((length) => length > 0))
        throw new RangeError(`grid.cell = ${shown(grid.cell)}: give lengths greater than 0`);
    const size = vector(grid.size, 'grid.size');
    size.forEach((cells, a) => whole(cells, `grid.size[${a}]`, 1, SIZE_MAX));
    return { origin: finite(grid.origin, 'grid.origin'), cell, size };
}

/** The grid that a caller gives, or asks for around a soup. */
export function gridFor(soup, grid) {
    return typeof grid === 'object' && grid !== null && 'resolution' in grid ? gridAround(soup, grid.resolution) : readGrid(grid);
}

/** The planes of cell (i, j, k). */
export function cellBox({ origin, cell }, at) {
    const corner = (more) => at.map((number, a) => plane(origin[a], number + more, cell[a]));
    return { lo: corner(0), hi: corner(1) };
}

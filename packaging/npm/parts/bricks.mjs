// bricks.mjs - tiles of a grid: which triangles are in which, and their cells as bricks of 8 x 8 x 8.
import { checkKeys, isObject, optionKeys, whole } from './arguments.mjs';
import { checkGrid, gridFor } from './grid.mjs';
import { shown } from './errors.mjs';
import { GRID_BYTES, OPTIONS_BYTES } from './memory.mjs';

const SIZE_MAX = 2 ** 32 - 1;

// What a call is about lies in a room of its own, as whatever takes bricks may make calls, too: grid, options, tiles, sink, report.
const OPTIONS = GRID_BYTES, TILES = OPTIONS + OPTIONS_BYTES, SINK = TILES + 12, REPORT = SINK + 8, ROOM_BYTES = REPORT + 8;

export const countOf = ({ size }, side) => size.reduce((tiles, cells) => tiles * Math.ceil(cells / side), 1);

/** The tiles of {side, first, count}: all of them by default. */
function readTiles(grid, tiles, most) {
    if (!isObject(tiles))
        throw new TypeError(`tiles = ${shown(tiles)}: give {side}, or {side, first, count}`);
    const side = whole(tiles.side, 'tiles.side', 1, most, 'the cells along a side of a tile');
    const all = countOf(grid, side), first = whole(tiles.first ?? 0, 'tiles.first', 0, all);
    const count = whole(tiles.count ?? all - first, 'tiles.count', 0, all - first, 'so that first + count is within the grid');
    if (first + count > SIZE_MAX)
        throw new RangeError(`tiles: the grid has ${all} of them, more than 2^32: give a larger side, or fewer`);
    return { side, first, count };
}

/** Runs work(about, starts, list) on what a call is about, and the lists of its tiles. */
function withLists(memory, triangles, { grid, tiles, options }, work) {
    checkGrid(memory, grid);
    const { length } = triangles, bytes = ROOM_BYTES + 4 * (tiles.count + 1);
    return memory.borrow(bytes, `lists of ${tiles.count} tiles`, (room) => {
        const about = { grid: memory.grid(grid, room), options: memory.options(options, room + OPTIONS), tiles: room + TILES,
            sink: room + SINK, report: room + REPORT }, starts = room + ROOM_BYTES;
        memory.words(about.tiles, 3).set([tiles.side, tiles.first, tiles.count]);
        const list = (to) => triangles.call(memory, 'tile_lists', about.grid, about.tiles, about.options, starts, to);
        list(0);
        const places = memory.words(starts, tiles.count + 1)[tiles.count];
        return memory.borrow(4 * places, `lists of ${places} triangles of ${length}`, (to) => {
            list(to);
            return work(about, starts, to, places);
        });
    });
}

export function tileLists(memory, triangles, numbers, asked, options) {
    checkKeys(options, optionKeys);
    void triangles.address;
    const grid = gridFor(memory, triangles, numbers), tiles = readTiles(grid, asked, SIZE_MAX);
    return withLists(memory, triangles, { grid, tiles, options }, (about, starts, list, places) => ({
        grid, starts: memory.words(starts, tiles.count + 1).slice(), list: memory.words(list, places).slice(),
    }));
}

/** What take is given of a brick. starts: of its lists; 0 without. */
function brickOf(memory, at, bits, starts, list) {
    const brick = [Array.from(memory.words(at, 3)), memory.words(bits, 16).slice()];
    if (!starts)
        return brick;
    const places = memory.words(starts, 513).slice();
    return [...brick, places, memory.words(list, places[512]).slice()];
}

/** Has bricks handed to take as long as work, which is told the number of that sink, goes on. Throws what take throws. */
function withTaker(memory, take, work) {
    const { takers } = memory;
    let thrown = null, isStopped = false;
    takers.push((...addresses) => {
        try {
            isStopped = take(...brickOf(memory, ...addresses)) === false;
        } catch (error) {
            thrown = { error };
        }
        return isStopped || thrown ? 1 : 0;
    });
    try {
        work(takers.length - 1, () => isStopped || thrown !== null);
    } finally {
        takers.pop();
    }
    if (thrown)
        throw thrown.error;
    return isStopped;
}

/** The taker of a call and its scratch: with lists that has room for the longest of the tiles. */
function takerOf(memory, { side, count }, starts, isListed) {
    const { exports } = memory;
    if (!isListed)
        return { taker: exports.sink_taker(), bytes: exports.tribox_bricks_bytes(side) >>> 0 };
    const longest = memory.words(starts, count + 1).reduce((most, end, t, all) => Math.max(most, t ? end - all[t - 1] : 0), 0);
    return { taker: exports.lists_taker(), bytes: exports.tribox_bricks_lists_bytes(side, longest) >>> 0 };
}

export function bricks(memory, triangles, numbers, asked, take, options) {
    checkKeys(options, [...optionKeys, 'lists']);
    void triangles.address;
    if (typeof take !== 'function')
        throw new TypeError(`take = ${shown(take)}: give a function, of (at, bits)`);
    const grid = gridFor(memory, triangles, numbers), tiles = readTiles(grid, asked, 1024);
    if (tiles.side % 8)
        throw new RangeError(`tiles.side = ${tiles.side}: give a multiple of 8`);
    return withLists(memory, triangles, { grid, tiles, options }, (about, starts, list) => {
        const { taker, bytes } = takerOf(memory, tiles, starts, options?.lists);
        return memory.borrow(bytes, `bricks of tiles of ${tiles.side} cells a side`, (scratch) => {
            const stopped = withTaker(memory, take, (number, hasEnded) => {
                memory.words(about.sink, 2).set([taker, number]);
                const args = [about.grid, about.tiles, starts, list, about.options, scratch, about.sink, about.report];
                try {
                    if (options?.lists)
                        triangles.call(memory, 'bricks_lists', ...args);
                    else
                        triangles.call(memory, 'bricks', ...args);
                } catch (error) {
                    if (!hasEnded())
                        throw error;
                }
            });
            return { grid, overlapping: memory.words(about.report, 1)[0], stopped };
        });
    });
}

// answers.test.mjs - the package answers as the library does here, on the scenes of the tests in C: a table of the ways to ask.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import test from 'node:test';
import { load } from './package_under_test.mjs';

const lines = execFileSync(process.env.TRIBOX_ANSWERS, { encoding: 'utf8', maxBuffer: 2 ** 28 }).trim().split('\n');
const questions = lines.slice(1).map((line) => JSON.parse(line));
const tribox = await load();
console.log(`${lines[0]}, ${questions.length} batches`);

const floats = (words) => new Float32Array(Uint32Array.from(words).buffer);
const doubles = (words) => new Float64Array(Uint32Array.from(words).buffer);
const range = (length) => Array.from({ length }, (_, i) => i);
const window = { first: [5, 1, 2], size: [60, 7, 2] };
const bitsIn = (words, count) => range(count).filter((i) => words[i >> 5] >>> (i & 31) & 1);
const bytesIn = (words) => Array.from(new Uint8Array(Uint32Array.from(words).buffer));

/** A mask of so many bits, of their numbers. */
function wordsOf(numbers, count) {
    const words = new Uint32Array(2 * Math.ceil(count / 64));
    numbers.forEach((i) => (words[i >> 5] |= 1 << (i & 31)));
    return words;
}

/** The vertices, the last one first. */
function inReverse(positions) {
    const reversed = positions.slice().reverse();
    for (let n = 0; n < reversed.length; n += 3)
        reversed.subarray(n, n + 3).reverse();
    return reversed;
}

/** What is set of the window: its cells, where their triangles begin, and the lowest of each cell. */
function windowOf({ windowStarts: starts, window: list }) {
    const { size } = window;
    const set = range(starts.length - 1).filter((c) => starts[c] < starts[c + 1]);
    const cells = set.flatMap((c) => [c % size[0], Math.floor(c / size[0]) % size[1], Math.floor(c / size[0] / size[1])]);
    return {
        windowSet: cells, windowBegins: [...set.map((c) => starts[c]), list.length],
        windowIds: range(starts.length - 1).map((c) => (starts[c] < starts[c + 1] ? list[starts[c]] : 2 ** 32 - 1)),
    };
}

/** All that can be expected of a question. */
function expectedOf(question, count) {
    const { first, firstMiss } = question, list = bitsIn(question.axes7, count), orientedList = bitsIn(question.oriented7, count);
    const bytes = question.children && { children: bytesIn(question.children), childrenAt: bytesIn(question.childrenAt) };
    return {
        ...question, ...bytes, ...(question.cells && windowOf(question)), list, count: list.length, orientedList,
        orientedCount: orientedList.length, insideCount: bitsIn(question.inside, count).length, isAny: list.length > 0,
        first: first === count ? -1 : first, firstMiss: firstMiss === count ? -1 : firstMiss,
    };
}

/** The triangles in every form that the package takes: soups of floats, and meshes; the first without indices. */
function formsOf({ isDouble, positions: words }) {
    const positions = isDouble ? doubles(words) : floats(words), reversed = inReverse(positions), vertices = positions.length / 3;
    const indices = Uint32Array.from({ length: vertices }, (_, k) => vertices - 1 - k);
    const given = [{ positions }, { positions: reversed, indices }, { positions: reversed, indices: Uint16Array.from(indices) }];
    return (isDouble ? ['mesh'] : ['soup', 'mesh']).flatMap((make) => given.map((mesh) => ({ make, mesh })));
}

/** Numbers of triangles, each some times. */
const someOf = (count) => range(2 * count + 1).map((k) => 7 * k % count);

/** [cell, bits, triangles] of each cell that bricks set, after each of which there may be another brick. */
function cellsOfBricks(triangles, grid, tiles, options) {
    const found = [];
    const { overlapping, stopped } = triangles.bricks(grid, tiles, (at, bits, begins, numbers) => {
        assert.ok(bits.some((word) => word));
        for (let c = 0; c < 512; c++)
            if (bits[c >> 5] >>> (c & 31) & 1)
                found.push([[c & 7, c >> 3 & 7, c >> 6].map((place, a) => 8 * at[a] + place),
                    numbers?.slice(begins[c], begins[c + 1])]);
            else
                assert.equal(begins?.[c], begins?.[c + 1]);
    }, options);
    assert.deepEqual([overlapping, stopped], [found.length, false]);
    return found;
}

/** The words of a grid that bricks set. */
function wordsOfBricks(triangles, grid, tiles) {
    const { size } = grid, row = 64 * Math.ceil(size[0] / 64);
    return wordsOf(cellsOfBricks(triangles, grid, tiles).map(([[i, j, k]]) => (k * size[1] + j) * row + i),
        row * size[1] * size[2]);
}

/** Triangles of the cells of a window, of bricks with lists. */
function listsOfBricks(triangles, grid, side) {
    const inside = cellsOfBricks(triangles, grid, { side }, { lists: true })
        .filter(([cell]) => cell.every((at, a) => at >= window.first[a] && at < window.first[a] + window.size[a]));
    inside.sort(([[i, j, k]], [[x, y, z]]) => k - z || j - y || i - x);
    return inside.flatMap(([, numbers]) => Array.from(numbers));
}

const groups = ['box', 'plane', 'edges'];
const filled = (a) => a.triangles.fillParity(a.voxels());

/** [answer, a way to ask for it] */
const ways = [
    ...range(8).slice(1).map((bits) => [`axes${bits}`, ({ triangles, box }) =>
        triangles.overlap(box, { axes: groups.filter((_, k) => bits >> k & 1) }).mask.words]),
    ...[123, 132, 213, 231, 312, 321].map((axisOrder) =>
        ['axes7', ({ triangles, box }) => triangles.overlap(box, { axisOrder }).mask.words]),
    ['axes7', ({ triangles, box }) => triangles.classify(box).mask.words],
    ['axes7', ({ index, box }) => index.overlap(box).mask.words],
    ['axes1', ({ index, box }) => index.overlap(box, { axes: ['box'] }).mask.words],
    ['axes7', ({ index, box }) => index.classify(box).mask.words],
    ['axes7', ({ index, box, count }) => wordsOf(index.list(box), count)],
    ['axes7', ({ sorted, box, count }) => wordsOf(sorted.index.list(box, { ids: true }), count)],
    ['axes7', ({ sorted, box, count }) =>
        wordsOf(sorted.triangles.overlap(box).mask.list().map((i) => sorted.triangles.ids[i]), count)],
    ['list', ({ triangles, box }) => triangles.overlap(box).mask.list()],
    ['list', ({ triangles, box, count }) => range(count).filter((i) => triangles.overlap(box).mask.has(i)), 7],
    ['list', ({ index, box }) => index.list(box)],
    ['count', ({ triangles, box }) => triangles.overlap(box).mask.count()],
    ['count', ({ triangles, box }) => triangles.overlap(box).overlapping],
    ['count', ({ triangles, box }) => triangles.classify(box).overlapping],
    ['count', ({ triangles, box }) => triangles.count(box)],
    ['count', ({ index, box }) => index.count(box)],
    ['count', ({ index, box }) => index.classify(box).overlapping],
    ['isAny', ({ index, box }) => index.any(box) !== -1],
    ['isAny', ({ index, box, expected }) => expected.list.includes(index.any(box))],
    ['inside', ({ triangles, box }) => triangles.classify(box).insideMask.words],
    ['inside', ({ index, box }) => index.classify(box).insideMask.words],
    ['insideCount', ({ triangles, box }) => triangles.classify(box).inside],
    ['insideCount', ({ index, box }) => index.classify(box).inside],
    ['first', ({ triangles, box }) => triangles.find(box)],
    ['first', ({ triangles, box }) => triangles.find(box, { what: 'hit' })],
    ['firstMiss', ({ triangles, box }) => triangles.find(box, { what: 'miss' })],
    ['children', ({ triangles, box }) => triangles.split(box)],
    ['childrenAt', ({ triangles, box, middle }) => triangles.split(box, { middle, axes: ['box'] })],
    ['oriented7', ({ triangles, oriented }) => triangles.overlap(oriented).mask.words],
    ['oriented7', ({ index, oriented }) => index.overlap(oriented).mask.words],
    ['oriented1', ({ triangles, oriented }) => triangles.overlap(oriented, { axes: ['box'] }).mask.words],
    ['orientedList', ({ index, oriented }) => index.list(oriented)],
    ['orientedCount', ({ triangles, oriented }) => triangles.count(oriented)],
    ['orientedCount', ({ index, oriented }) => (index.any(oriented) === -1 ? 0 : index.count(oriented))],
    ['cells', (a) => a.voxels().bits],
    ['cells', ({ triangles, grid }) => wordsOfBricks(triangles, grid, { side: 8 })],
    ['cells', ({ triangles, grid }) => wordsOfBricks(triangles, grid, { side: 128 })],
    ['cells', ({ triangles, grid }) => {
        const [low, high] = [{ count: 7 }, { first: 7 }].map((share) => wordsOfBricks(triangles, grid, { side: 8, ...share }));
        return low.map((word, k) => word | high[k]);
    }],
    ['thin', ({ triangles, grid }) => triangles.voxelize(grid, { thin: true }).bits],
    ['outside', (a) => a.voxels().fillOutside().solid.bits],
    ['outsideInside', (a) => a.voxels().fillOutside().inside],
    ['parity', (a) => filled(a).solid.bits],
    ['parityInside', (a) => filled(a).inside],
    ['parityOdd', (a) => filled(a).oddRows],
    ['windowCells', ({ triangles, grid }) => triangles.voxelize(grid, { window }).bits],
    ['windowCells', ({ triangles, grid }) => triangles.voxelize(grid, { window, ids: true }).bits],
    ['windowThin', ({ triangles, grid, into }) => triangles.voxelize(grid, { window, into, thin: true }).bits],
    ['windowCells', ({ triangles, into }) => triangles.voxelize(into, { into }).bits],
    ['windowIds', ({ triangles, grid }) => triangles.voxelize(grid, { window, ids: true }).ids],
    ['windowSet', ({ triangles, grid }) => triangles.cellLists(grid, { window }).cells],
    ['windowSet', ({ triangles, grid }) => triangles.voxelize(grid, { window }).list()],
    ['windowBegins', ({ triangles, grid }) => triangles.cellLists(grid, { window }).starts],
    ['window', ({ triangles, grid }) => triangles.cellLists(grid, { window }).list],
    ['window', ({ triangles, grid }) => listsOfBricks(triangles, grid, 8)],
    ['window', ({ triangles, grid }) => listsOfBricks(triangles, grid, 64)],
    ['tilesStarts', ({ triangles, grid }) => triangles.tileLists(grid, { side: 8 }).starts],
    ['tiles', ({ triangles, grid }) => triangles.tileLists(grid, { side: 8 }).list],
];

/** A question in one form: what is asked, and about what. */
function aboutOf(question, { make, mesh }) {
    const triangles = tribox[make](mesh), made = tribox[make](mesh, { sort: true });
    const [numbers, oriented, grid] = [question.box, question.oriented, question.grid].map(doubles);
    const box = { lo: numbers.slice(0, 3), hi: numbers.slice(3, 6) };
    return {
        triangles, index: triangles.index(), sorted: { triangles: made, index: made.index() }, box, count: triangles.length,
        middle: [box.lo[0], box.hi[1], box.lo[2]],
        grid: { origin: grid.slice(0, 3), cell: grid.slice(3, 6), size: question.grid.slice(12, 15) },
        oriented: { center: oriented.slice(0, 3), half: oriented.slice(3, 6),
            axis: [6, 9, 12].map((at) => oriented.slice(at, at + 3)) },
        voxels() {
            return triangles.voxelize(this.grid);
        },
        expected: expectedOf(question, triangles.length),
    };
}

function freeAll({ triangles, index, sorted, into }) {
    [index, triangles, sorted.index, sorted.triangles, into].forEach((object) => object?.free());
}

function eachForm(check) {
    for (const question of questions)
        for (const form of formsOf(question)) {
            const about = aboutOf(question, form);
            about.into = question.cells && tribox.voxels(about.grid, window);
            try {
                check(about, about.expected, `${question.scene}, ${about.count} in a ${form.make}`, form);
            } finally {
                freeAll(about);
            }
        }
}

test('every way to ask', () => eachForm((about, expected, what) => {
    const asked = ways.filter(([name, , step]) => name in expected && (!step || about.count < 1000));
    for (const [name, ask] of asked) {
        const answer = ask(about), is = typeof answer === 'object' ? Array.from(answer) : answer;
        assert.deepEqual(is, expected[name], `${what}: ${name} by ${ask}`);
    }
    if (!expected.cells)
        assert.throws(() => about.voxels(), RangeError, what);
}));

test('conservative never misses, and fast errs on few ordinary triangles', () => eachForm(
    ({ triangles, box, expected }, { axes7 }, what) => {
    const [more, fast] = ['conservative', 'fast'].map((accuracy) => triangles.overlap(box, { accuracy }).mask.words);
    axes7.forEach((word, k) => assert.equal(word & ~more[k], 0, what));
    if (!expected.isDouble && (expected.scene === 'paper' || expected.scene === 'eighths'))
        assert.deepEqual(Array.from(fast), axes7, what);
}));

test('numbers of triangles: some, the sorted, those of a share', () => eachForm((about, expected, what, { make, mesh }) => {
    const { triangles, box, oriented, grid, index, sorted, count } = about, numbers = someOf(count);
    if (expected.children)
        assert.deepEqual(Array.from(triangles.split(box, { list: numbers })), numbers.map((i) => expected.children[i]), what);
    if (make === (expected.isDouble ? 'mesh' : 'soup') && !mesh.indices)
        assert.deepEqual(Array.from(sorted.triangles.ids), expected.order, what);
    for (const axis of make === 'soup' ? ['x', 'y', 'z'] : [])
        for (let v = 0; v < 3; v++)
            sorted.triangles.ids.forEach((i, k) => assert.ok(Object.is(sorted.triangles[axis][v][k], triangles[axis][v][i]), what));
    const { starts, list } = index.lists([box, oriented, box]), everywhere = { lo: [-3e38, -3e38, -3e38], hi: [3e38, 3e38, 3e38] };
    assert.deepEqual(Array.from(list), [...expected.list, ...expected.orientedList, ...expected.list], what);
    assert.deepEqual(Array.from(starts.subarray(0, 3)), [0, expected.count, expected.count + expected.orientedCount], what);
    assert.deepEqual(index.list(everywhere), triangles.overlap(everywhere).mask.list(), what);
    if (!expected.cells)
        return;
    const share = triangles.tileLists(grid, { side: 8, first: 3, count: 4 }), all = expected.tilesStarts;
    assert.deepEqual(Array.from(share.list), expected.tiles.slice(all[3], all[7]), what);
    assert.deepEqual(Array.from(share.starts), all.slice(3, 8).map((start) => start - all[3]), what);
    const voxels = about.voxels(), lists = triangles.cellLists(grid);
    for (let n = 0; n < lists.cells.length / 3; n += 97) {
        const cell = lists.cells.subarray(3 * n, 3 * n + 3), { mask } = triangles.overlap(voxels.box(...cell));
        assert.ok(voxels.has(...cell), what);
        assert.deepEqual(mask.list(), lists.list.slice(lists.starts[n], lists.starts[n + 1]), what);
    }
    assert.equal(voxels.count(), lists.cells.length / 3, what);
    assert.deepEqual(about.into.box(3, 2, 1), voxels.box(8, 3, 3), what);
}));

test('tiles are counted', () => {
    assert.equal(tribox.tileCount([100, 7, 33], 8), 13 * 5);
    assert.equal(tribox.tileCount({ x: 128, y: 129, z: 1 }, 128), 2);
    assert.equal(tribox.tileCount([2 ** 20, 2 ** 20, 2 ** 20], 8), 2 ** 51);
});

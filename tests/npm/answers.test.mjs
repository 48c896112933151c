// answers.test.mjs - the package answers as the library does here, on the scenes of the tests in C.
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
const boxOf = (numbers) => ({ lo: numbers.slice(0, 3), hi: numbers.slice(3, 6) });

/** Bit by bit, in words for people to read. */
function expectWords(actual, expected, what) {
    assert.deepEqual(Array.from(actual), expected, what);
}

const groups = ['box', 'plane', 'edges'];
const axesOf = (bits) => groups.filter((_, k) => bits >> k & 1);
const orders = [123, 132, 213, 231, 312, 321];
const bitsIn = (mask) => Array.from({ length: mask.length }, (_, i) => i).filter((i) => mask.has(i));

/** The vertices, the last one first. */
function inReverse(positions) {
    const reversed = positions.slice().reverse();
    for (let n = 0; n < reversed.length; n += 3)
        reversed.subarray(n, n + 3).reverse();
    return reversed;
}

/** All that a question is about, in the memory of the instance. */
function prepare(question) {
    const streams = Array.from({ length: 9 }, (_, k) => floats(question[`s${k}`])), count = streams[0].length;
    const positions = new Float32Array(9 * count);
    for (let i = 0; i < count; i++)
        for (let k = 0; k < 9; k++)
            positions[9 * i + 3 * (k % 3) + Math.floor(k / 3)] = streams[k][i];
    const oriented = doubles(question.oriented), grid = doubles(question.grid);
    return {
        count, positions, what: question.scene, soup: tribox.soup({ positions }), box: boxOf(doubles(question.box)),
        grid: { origin: grid.slice(0, 3), cell: grid.slice(3, 6), size: question.grid.slice(12, 15) },
        oriented: {
            center: oriented.slice(0, 3), half: oriented.slice(3, 6),
            axis: [oriented.slice(6, 9), oriented.slice(9, 12), oriented.slice(12, 15)],
        },
    };
}

function eachQuestion(check) {
    for (const question of questions) {
        const about = prepare(question);
        try {
            check(question, about);
        } finally {
            about.soup.free();
        }
    }
}

test('overlap: every set of axes, every order', () => eachQuestion((question, { soup, box, what }) => {
    for (let bits = 1; bits <= 7; bits++)
        expectWords(soup.overlap(box, { axes: axesOf(bits) }).mask.words, question[`axes${bits}`], `${what}, axes ${bits}`);
    for (const order of orders)
        expectWords(soup.overlap(box, { axisOrder: order }).mask.words, question.axes7, `${what}, order ${order}`);
}));

test('count, report and list agree with the mask', () => eachQuestion((question, { soup, box, what }) => {
    const { overlapping, mask } = soup.overlap(box), set = bitsIn(mask);
    assert.equal(overlapping, set.length, what);
    assert.equal(mask.count(), set.length, what);
    assert.equal(soup.count(box), set.length, what);
    assert.deepEqual(Array.from(mask.list()), set, what);
}));

test('conservative never misses', () => eachQuestion((question, { soup, box, what }) => {
    const { words } = soup.overlap(box, { accuracy: 'conservative' }).mask;
    question.axes7.forEach((word, k) => assert.equal(word & ~words[k], 0, what));
}));

test('fast errs on few ordinary triangles', () => eachQuestion((question, { soup, box, what }) => {
    if (what !== 'paper' && what !== 'eighths')
        return;
    const { words } = soup.overlap(box, { accuracy: 'fast' }).mask;
    expectWords(words, question.axes7, what);
}));

test('classify', () => eachQuestion((question, { soup, box, what }) => {
    const classes = soup.classify(box);
    expectWords(classes.mask.words, question.axes7, what);
    expectWords(classes.insideMask.words, question.inside, what);
    assert.equal(classes.inside, bitsIn(classes.insideMask).length, what);
    assert.equal(classes.overlapping, classes.mask.count(), what);
}));

const placeOf = (number, count) => (number === count ? -1 : number);

test('find', () => eachQuestion((question, { soup, box, count, what }) => {
    assert.equal(soup.find(box), placeOf(question.first, count), what);
    assert.equal(soup.find(box, { what: 'hit' }), placeOf(question.first, count), what);
    assert.equal(soup.find(box, { what: 'miss' }), placeOf(question.firstMiss, count), what);
}));

/** By a call about each child. */
function expectSplit(triangles, box, middle, options, what) {
    const at = middle ?? box.lo.map((lo, a) => (lo + box.hi[a]) / 2), expected = new Uint8Array(triangles.length);
    for (let c = 0; c < 8; c++) {
        const side = (a) => c >> a & 1, lo = box.lo.map((number, a) => (side(a) ? at[a] : number));
        const hi = box.hi.map((number, a) => (side(a) ? number : at[a]));
        triangles.overlap({ lo, hi }, options).mask.list().forEach((i) => expected[i] |= 1 << c);
    }
    const list = Array.from({ length: 2 * triangles.length + 1 }, (_, k) => 7 * k % triangles.length), given = middle && { middle };
    assert.deepEqual(triangles.split(box, { ...options, ...given }), expected, what);
    assert.deepEqual(triangles.split(box, { ...options, ...given, list }), Uint8Array.from(list, (i) => expected[i]), what);
}

test('split', () => eachQuestion((question, { soup, box, what, count }) => {
    if (box.lo.some((lo, a) => !(lo <= box.hi[a] && Number.isFinite(lo + box.hi[a]))))
        return;
    const mesh = tribox.mesh({ positions: doubles(question.positions) });
    for (const triangles of [soup, mesh]) {
        expectSplit(triangles, box, undefined, {}, `${what}, ${count}`);
        expectSplit(triangles, box, [box.lo[0], box.hi[1], box.lo[2]], { axes: ['box'] }, what);
    }
    mesh.free();
}));

test('oriented boxes', () => eachQuestion((question, { soup, oriented, what }) => {
    expectWords(soup.overlap(oriented).mask.words, question.orientedMask, what);
    expectWords(soup.overlap(oriented, { axes: ['box'] }).mask.words, question.orientedBounds, what);
    assert.equal(soup.count(oriented), soup.overlap(oriented).overlapping, what);
}));

/** The doubles of a question as they are, and by indices of either kind. */
function eachMesh({ positions: words }, count, options, check) {
    const positions = doubles(words), reversed = inReverse(positions);
    const indices = Uint32Array.from({ length: 3 * count }, (_, k) => 3 * count - 1 - k);
    for (const given of [{ positions }, { positions: reversed, indices }, { positions: reversed, indices: Uint16Array.from(indices) }]) {
        const mesh = tribox.mesh(given, options);
        check(mesh);
        mesh.free();
    }
}

test('doubles', () => eachQuestion((question, { box, oriented, what, count }) => eachMesh(question, count, {}, (mesh) => {
    const classes = mesh.classify(box);
    expectWords(classes.mask.words, question.meshMask, what);
    expectWords(classes.insideMask.words, question.meshInside, what);
    expectWords(mesh.overlap(box).mask.words, question.meshMask, what);
    expectWords(mesh.overlap(oriented).mask.words, question.meshOriented, what);
    assert.equal(mesh.count(box), classes.overlapping, what);
    assert.equal(mesh.find(box), placeOf(question.meshFirst, count), what);
    assert.equal(mesh.find(box, { what: 'miss' }), placeOf(question.meshFirstMiss, count), what);
})));

test('an index over doubles', () => eachQuestion((question, { box, oriented, what, count }) => {
    eachMesh(question, count, {}, (mesh) => {
        const index = mesh.index(), set = bitsIn(mesh.overlap(box).mask), any = index.any(box), classes = index.classify(box);
        expectWords(index.overlap(box).mask.words, question.meshMask, what);
        expectWords(index.overlap(oriented).mask.words, question.meshOriented, what);
        expectWords(classes.mask.words, question.meshMask, what);
        expectWords(classes.insideMask.words, question.meshInside, what);
        assert.deepEqual(Array.from(index.list(box)), set, what);
        assert.deepEqual(Array.from(index.list(oriented)), bitsIn(mesh.overlap(oriented).mask), what);
        assert.ok(set.length ? set.includes(any) : any === -1, what);
        index.free();
    });
    eachMesh(question, count, { sort: true }, (mesh) => {
        const index = mesh.index();
        if (!mesh.indices) // else another vertex is the first, from which the order of doubles is seen
            expectWords(mesh.ids, question.meshOrder, what);
        const found = Array.from(index.list(box, { ids: true })).sort((i, j) => i - j);
        expectWords(index.list(box), bitsIn(mesh.overlap(box).mask), what);
        const { words } = tribox.mask(count), expected = Uint32Array.from(question.meshMask);
        found.forEach((i) => (words[i >>> 5] |= 1 << (i & 31)));
        expectWords(words, Array.from(expected), what);
        index.free();
    });
}));

test('an index', () => eachQuestion((question, { soup, box, oriented, what }) => {
    const index = soup.index(), set = bitsIn(soup.overlap(box).mask), any = index.any(box);
    expectWords(index.overlap(box).mask.words, question.axes7, what);
    expectWords(index.overlap(oriented).mask.words, question.orientedMask, what);
    assert.deepEqual(Array.from(index.list(box)), set, what);
    assert.deepEqual(Array.from(index.list(oriented)), bitsIn(index.overlap(oriented).mask), what);
    assert.equal(index.count(box), set.length, what);
    assert.ok(set.length ? set.includes(any) : any === -1, what);
    assert.equal(index.any(oriented) === -1, index.count(oriented) === 0, what);
    const classes = index.classify(box);
    expectWords(classes.mask.words, question.axes7, what);
    expectWords(classes.insideMask.words, question.inside, what);
    assert.equal(classes.overlapping, set.length, what);
    const everywhere = { lo: [-3e38, -3e38, -3e38], hi: [3e38, 3e38, 3e38] };
    assert.deepEqual(Array.from(index.list(everywhere)), bitsIn(soup.overlap(everywhere).mask), what);
    index.free();
}));

test('a sorted soup', () => eachQuestion((question, { soup, positions, box, count, what }) => {
    const sorted = tribox.soup({ positions }, { sort: true }), index = sorted.index();
    expectWords(sorted.ids, question.order, what);
    for (const axis of ['x', 'y', 'z'])
        for (let v = 0; v < 3; v++)
            for (let i = 0; i < count; i++)
                assert.ok(Object.is(sorted[axis][v][i], soup[axis][v][sorted.ids[i]]), what);
    const listed = index.list(box, { ids: true }).sort((i, j) => i - j);
    assert.deepEqual(Array.from(listed), bitsIn(soup.overlap(box).mask), what);
    assert.deepEqual(Array.from(index.list(box)), bitsIn(sorted.overlap(box).mask), what);
    index.free();
    sorted.free();
}));

test('triangles by indices', () => eachQuestion((question, { positions, box, count, what }) => {
    const vertices = 3 * count, reversed = inReverse(positions);
    for (const Indices of [Uint32Array, Uint16Array]) {
        const soup = tribox.soup({ positions: reversed, indices: Indices.from({ length: vertices }, (_, k) => vertices - 1 - k) });
        expectWords(soup.overlap(box).mask.words, question.axes7, what);
        soup.free();
    }
}));

/** Of questions whose grid is served. */
function eachGrid(check) {
    eachQuestion((question, about) => {
        if (question.cells)
            check(question, about);
        else
            assert.throws(() => about.soup.voxelize(about.grid), RangeError, about.what);
    });
}

test('voxels', () => eachGrid((question, { soup, grid, what }) => {
    const voxels = soup.voxelize(grid), { size } = voxels;
    expectWords(voxels.bits, question.cells, what);
    expectWords(soup.voxelize(grid, { thin: true }).bits, question.thin, what);
    const set = [];
    for (let k = 0; k < size[2]; k++)
        for (let j = 0; j < size[1]; j++)
            for (let i = 0; i < size[0]; i++)
                if (voxels.has(i, j, k))
                    set.push(i, j, k);
    assert.deepEqual(Array.from(voxels.list()), set, what);
    assert.equal(voxels.count(), set.length / 3, what);
    for (let at = 0; at < set.length; at += 3 * 97)
        assert.ok(soup.count(voxels.box(...set.slice(at, at + 3))) > 0, what);
}));

test('voxels of doubles, and of windows', () => eachGrid((question, { grid, count, what }) => eachMesh(question, count, {}, (mesh) => {
    const window = { first: [5, 1, 2], size: [60, 7, 2] }, voxels = mesh.voxelize(grid), some = mesh.voxelize(grid, { window });
    expectWords(voxels.bits, question.meshCells, what);
    expectWords(some.bits, question.meshWindow, what);
    assert.deepEqual(some.box(3, 2, 1), voxels.box(8, 3, 3), what);
    const into = tribox.voxels(grid, window);
    expectWords(mesh.voxelize(into, { into, thin: true }).bits, question.meshThinWindow, what);
    expectWords(mesh.voxelize(into, { into }).bits, question.meshWindow, what);
    into.free();
})));

test('fills', () => eachGrid((question, { soup, grid, count, what }) => {
    const voxels = soup.voxelize(grid), outside = voxels.fillOutside(), parity = soup.fillParity(voxels);
    expectWords(outside.solid.bits, question.outside, what);
    assert.equal(outside.inside, question.outsideInside, what);
    expectWords(parity.solid.bits, question.parity, what);
    assert.equal(parity.oddRows, question.parityOdd, what);
    eachMesh(question, count, {}, (mesh) => {
        const filled = mesh.fillParity(voxels);
        expectWords(filled.solid.bits, question.meshParity, what);
        assert.equal(filled.inside, question.meshParityInside, what);
    });
}));

test('tile lists', () => eachGrid((question, { soup, grid, count, what }) => {
    const { starts, list } = soup.tileLists(grid, { side: 8 }), share = soup.tileLists(grid, { side: 8, first: 3, count: 4 });
    expectWords(starts, question.tileStarts, what);
    expectWords(list, question.tiles, what);
    expectWords(share.list, Array.from(list.slice(starts[3], starts[7])), what);
    expectWords(share.starts, Array.from(starts.slice(3, 8), (start) => start - starts[3]), what);
    eachMesh(question, count, {}, (mesh) => expectWords(mesh.tileLists(grid, { side: 8 }).list, question.meshTiles, what));
}));

/** The words of a grid that bricks set. */
function wordsOfBricks(triangles, grid, tiles) {
    const { size } = grid, row = 2 * Math.ceil(size[0] / 64), words = new Uint32Array(row * size[1] * size[2]);
    let handed = 0;
    const take = (at, bits) => {
        assert.ok(bits.some((word) => word));
        for (let b = 0; b < 512; b++)
            if (bits[b >> 5] >>> (b & 31) & 1) {
                const [i, j, k] = [b & 7, b >> 3 & 7, b >> 6].map((cell, a) => 8 * at[a] + cell);
                words[(k * size[1] + j) * row + (i >> 5)] |= 1 << (i & 31);
                handed++;
            }
    };
    const { overlapping, stopped } = triangles.bricks(grid, tiles, take);
    assert.deepEqual([overlapping, stopped], [handed, false]);
    return words;
}

test('bricks', () => eachGrid((question, { soup, grid, count, what }) => {
    for (const side of [8, 128])
        expectWords(wordsOfBricks(soup, grid, { side }), question.cells, what);
    const [low, high] = [{ count: 7 }, { first: 7 }].map((share) => wordsOfBricks(soup, grid, { side: 8, ...share }));
    expectWords(low.map((word, k) => word | high[k]), question.cells, what);
    eachMesh(question, count, {}, (mesh) => expectWords(wordsOfBricks(mesh, grid, { side: 64 }), question.meshCells, what));
}));

/** By a mesh's answers for the box of each cell. */
function checkCells(triangles, grid, window, what) {
    const voxels = triangles.voxelize(grid, { window, ids: true }), { size } = voxels, { cells, starts, list } =
        triangles.cellLists(grid, { window });
    expectWords(triangles.voxelize(grid, { window }).bits, Array.from(voxels.bits), what);
    expectWords(cells, Array.from(voxels.list()), what);
    assert.deepEqual([starts[0], starts.length, starts.at(-1)], [0, cells.length / 3 + 1, list.length], what);
    const boxes = [];
    const ids = new Uint32Array(size[0] * size[1] * size[2]).fill(2 ** 32 - 1);
    for (let n = 0; n < cells.length / 3; n++) {
        const [i, j, k] = cells.subarray(3 * n, 3 * n + 3);
        boxes.push(voxels.box(i, j, k));
        ids[(k * size[1] + j) * size[0] + i] = list[starts[n]];
    }
    expectWords(voxels.ids, Array.from(ids), what);
    for (let n = 0; n < boxes.length; n += 1 + (boxes.length >> 6))
        expectWords(list.slice(starts[n], starts[n + 1]), bitsIn(triangles.overlap(boxes[n]).mask), what);
    return boxes;
}

/** The lists of bricks are those of the cells of the whole grid. */
function checkListsOfBricks(triangles, grid, side, what) {
    const { cells, starts, list } = triangles.cellLists(grid), found = new Map();
    const { overlapping, stopped } = triangles.bricks(grid, { side }, (at, bits, begins, numbers) => {
        for (let c = 0; c < 512; c++)
            if (bits[c >> 5] >>> (c & 31) & 1)
                found.set([c & 7, c >> 3 & 7, c >> 6].map((place, a) => 8 * at[a] + place).join(), numbers.slice(begins[c], begins[c + 1]));
            else
                assert.equal(begins[c], begins[c + 1], what);
    }, { lists: true });
    assert.deepEqual([overlapping, found.size, stopped], [cells.length / 3, cells.length / 3, false], what);
    for (let n = 0; n < found.size; n++)
        expectWords(found.get(cells.subarray(3 * n, 3 * n + 3).join()), Array.from(list.subarray(starts[n], starts[n + 1])), what);
}

test('which triangle is in which cell', () => eachGrid((question, { soup, grid, count, what }) => {
    checkListsOfBricks(soup, grid, 64, what);
    const window = { first: [5, 1, 2], size: [60, 7, 2] }, boxes = checkCells(soup, grid, undefined, what), index = soup.index();
    const some = boxes.filter((_, n) => n % 50 === 0), lists = index.lists(some);
    assert.equal(lists.starts.length, some.length + 1, what);
    some.forEach((box, n) => expectWords(lists.list.slice(lists.starts[n], lists.starts[n + 1]), Array.from(index.list(box)), what));
    index.free();
    eachMesh(question, count, {}, (mesh) => {
        checkCells(mesh, grid, window, what);
        checkListsOfBricks(mesh, grid, 8, what);
    });
}));

test('tiles are counted', () => {
    assert.equal(tribox.tileCount([100, 7, 33], 8), 13 * 5);
    assert.equal(tribox.tileCount({ x: 128, y: 129, z: 1 }, 128), 2);
    assert.equal(tribox.tileCount([2 ** 20, 2 ** 20, 2 ** 20], 8), 2 ** 51);
    for (const [size, side] of [[[1, 2], 8], [[1, 2, -1], 8], [[1, 2, 3], 0], ['abc', 8], [[1, 2, 3], '8']])
        assert.throws(() => tribox.tileCount(size, side), /^(TypeError|RangeError): si[dz]e/);
});

test('ids and lists say what they do not take', () => {
    const soup = tribox.soup({ positions: new Float32Array(9) }), grid = { origin: [0, 0, 0], cell: 1, size: [4, 4, 4] };
    const index = soup.index(), into = tribox.voxels(grid);
    assert.throws(() => soup.voxelize(grid, { into, ids: true }), /^TypeError: options.ids and options.into/);
    assert.throws(() => soup.voxelize(grid, { thin: true, ids: true }), /^TypeError: options.ids and options.thin/);
    assert.throws(() => soup.voxelize(grid, { thin: true, accuracy: 'fast' }), /^TriboxError: tribox_voxelize_thin: an option/);
    assert.equal(soup.voxelize(grid).ids, null);
    assert.throws(() => soup.cellLists(grid, { window: { first: [2, 0, 0], size: [3, 1, 1] } }), /^RangeError: window/);
    assert.throws(() => soup.cellLists(grid, { ids: true }), /^TypeError: options.ids is unknown/);
    assert.deepEqual(Array.from(soup.cellLists(grid, { window: { first: [4, 4, 4], size: [0, 0, 0] } }).starts), [0]);
    assert.throws(() => index.lists({ lo: [0, 0, 0], hi: [1, 1, 1] }), /^TypeError: boxes = /);
    assert.throws(() => index.lists([{ lo: [0, 0, 0] }]), /^TypeError: box = /);
    assert.deepEqual(Array.from(index.lists([]).starts), [0]);
    soup.free();
    assert.throws(() => soup.cellLists(grid), { name: 'TriboxError', message: 'this soup was freed' });
    assert.throws(() => index.lists([{ lo: [0, 0, 0], hi: [1, 1, 1] }]), { name: 'TriboxError' });
    into.free();
});

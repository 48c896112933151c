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
    const oriented = floats(question.oriented);
    return {
        count, positions, what: question.scene, soup: tribox.soup({ positions }), box: boxOf(floats(question.box)),
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
        expectWords(soup.overlap(box, { order }).mask.words, question.axes7, `${what}, order ${order}`);
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

test('first and firstMiss', () => eachQuestion((question, { soup, box, count, what }) => {
    const place = (number) => number === count ? -1 : number;
    assert.equal(soup.first(box), place(question.first), what);
    assert.equal(soup.firstMiss(box), place(question.firstMiss), what);
}));

test('oriented boxes', () => eachQuestion((question, { soup, oriented, what }) => {
    expectWords(soup.overlap(oriented).mask.words, question.orientedMask, what);
    expectWords(soup.overlap(oriented, { axes: ['box'] }).mask.words, question.orientedBounds, what);
    assert.equal(soup.count(oriented), soup.overlap(oriented).overlapping, what);
}));

test('doubles, as they are and by indices', () => eachQuestion((question, { what, count }) => {
    const box = boxOf(doubles(question.boxF64)), positions = doubles(question.positions);
    const reversed = inReverse(positions), indices = Uint32Array.from({ length: 3 * count }, (_, k) => 3 * count - 1 - k);
    for (const given of [{ positions }, { positions: reversed, indices }, { positions: reversed, indices: Uint16Array.from(indices) }]) {
        const mesh = tribox.mesh(given), classes = mesh.classify(box), place = classes.mask.list()[0] ?? -1;
        expectWords(classes.mask.words, question.maskF64, what);
        expectWords(classes.insideMask.words, question.insideF64, what);
        expectWords(mesh.overlap(box).mask.words, question.maskF64, what);
        assert.equal(mesh.count(box), classes.overlapping, what);
        assert.equal(mesh.first(box), place, what);
        mesh.free();
    }
}));

test('an index', () => eachQuestion((question, { soup, box, oriented, what }) => {
    const index = soup.index(), set = bitsIn(soup.overlap(box).mask), any = index.any(box);
    expectWords(index.overlap(box).mask.words, question.axes7, what);
    expectWords(index.overlap(oriented).mask.words, question.orientedMask, what);
    assert.deepEqual(Array.from(index.list(box)), set, what);
    assert.deepEqual(Array.from(index.list(oriented)), bitsIn(index.overlap(oriented).mask), what);
    assert.equal(index.count(box), set.length, what);
    assert.ok(set.length ? set.includes(any) : any === -1, what);
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
    const listed = index.list(box, { ids: true }).sort();
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

test('voxels', () => eachQuestion((question, { soup, what }) => {
    const numbers = floats(question.grid), size = Array.from(Uint32Array.from(question.grid).slice(6));
    const grid = { origin: numbers.slice(0, 3), cell: numbers.slice(3, 6), size };
    if (!question.cells) {
        assert.throws(() => soup.voxelize(grid), RangeError, what);
        return;
    }
    const voxels = soup.voxelize(grid);
    expectWords(voxels.bits, question.cells, what);
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

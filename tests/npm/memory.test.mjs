// memory.test.mjs - views, masks and voxels in the memory, its growth and its end, and what is freed.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load, middleBox, randomPositions, TriboxError } from './package_under_test.mjs';

const COUNT = 1000;
const positions = randomPositions(COUNT);
const oriented = { center: [0, 0, 0], half: [0.5, 0.5, 0.5], axis: [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]] };
const grid = { origin: [-2, -2, -2], cell: 0.5, size: [8, 8, 8] };

const bytesOf = (tribox) => tribox.memory.buffer.byteLength;

/** Takes memory without touching it, until it has grown. */
function grow(tribox) {
    const before = bytesOf(tribox), taken = tribox.exports.malloc(before);
    assert.ok(bytesOf(tribox) > before);
    return taken;
}

/** Takes all memory that there is, down to pieces of 16 bytes, and returns what it took. */
function exhaust(tribox) {
    const taken = [];
    for (let bytes = 2 ** 30; bytes >= 16; bytes /= 2)
        for (let address; (address = tribox.exports.malloc(bytes));)
            taken.push(address);
    return taken;
}

test('a soup that is filled in place is the one that is copied', async () => {
    const tribox = await load(), copied = tribox.soup({ positions }), filled = tribox.allocSoup(COUNT);
    assert.equal(filled.count({ lo: [-9, -9, -9], hi: [9, 9, 9] }), 0, 'NaN at first');
    for (const [a, axis] of ['x', 'y', 'z'].entries())
        filled[axis].forEach((stream, v) => {
            assert.equal(stream.buffer, tribox.memory.buffer);
            assert.equal(stream.length, COUNT);
            for (let i = 0; i < COUNT; i++)
                stream[i] = positions[9 * i + 3 * v + a];
        });
    assert.deepEqual(filled.overlap(middleBox).mask.words, copied.overlap(middleBox).mask.words);
});

test('views die when the memory grows, and new ones show the same', async () => {
    const tribox = await load(), soup = tribox.soup({ positions }), mesh = tribox.mesh({ positions });
    const mask = tribox.mask(COUNT), voxels = tribox.voxels(grid), own = soup.overlap(middleBox, {}).mask;
    soup.overlap(middleBox, { into: mask });
    soup.voxelize(grid, { into: voxels });
    const views = () => [soup.x[1], soup.z[2], mesh.positions, mask.words, voxels.bits], old = views();
    const copies = old.map((view) => view.slice()), ownWords = own.words;
    grow(tribox);
    old.forEach((view) => assert.equal(view.length, 0));
    assert.deepEqual(views(), copies);
    assert.deepEqual(own.words, ownWords);
    assert.ok(ownWords.length > 0);
    assert.deepEqual(soup.overlap(middleBox).mask.words, copies[3]);
});

test('views of the memory are read as they were, though it grows for what is made of them', async () => {
    const tribox = await load(), many = randomPositions(7000), order = Uint32Array.from({ length: 21000 }, (_, k) => k);
    const expected = tribox.soup({ positions: many }).overlap(middleBox).mask.words;
    for (const [make, positions, indices] of [['soup', many, null], ['soup', many, order], ['soup', many, Uint16Array.from(order)],
        ['mesh', many, order], ['mesh', Float64Array.from(many), Uint16Array.from(order)]])
        for (const [name, own] of Object.entries(indices ? { positions, indices } : { positions }))
            for (let isGrown = false; !isGrown;) {
                const address = tribox.exports.malloc(own.byteLength);
                const view = new own.constructor(tribox.memory.buffer, address, own.length);
                view.set(own);
                const made = tribox[make]({ positions, indices, [name]: view });
                isGrown = view.length === 0;
                assert.deepEqual(made.overlap(middleBox).mask.words, expected, `${make} of ${name} in the memory`);
            }
    const mesh = tribox.mesh({ positions: many }), { positions } = mesh;
    assert.deepEqual(tribox.soup({ positions }, { sort: true }).count(middleBox), mesh.count(middleBox));
});

test('views that died are refused', async () => {
    const tribox = await load(), view = tribox.mesh({ positions }).positions, indices = new Uint32Array(6);
    grow(tribox);
    structuredClone(indices, { transfer: [indices.buffer] });
    for (const make of ['soup', 'mesh']) {
        assert.throws(() => tribox[make]({ positions: view }), { name: 'TypeError',
            message: /^mesh\.positions is a view of a memo/ });
        assert.throws(() => tribox[make]({ positions, indices }), { name: 'TypeError',
            message: /^mesh\.indices is a view of a memory/ });
    }
});

test('a mesh that cannot be copied gives its room back', async () => {
    // Says that it is shorter than it is.
    class Short extends Float32Array {
        get length() {
            return super.length - 9;
        }
    }
    const tribox = await load(), refused = () => assert.throws(() => tribox.mesh({ positions: new Short(90000) }), RangeError);
    refused();
    const bytes = bytesOf(tribox);
    for (let k = 0; k < 30; k++)
        refused();
    assert.equal(bytesOf(tribox), bytes);
});

test('a mask in the memory is clear, whatever was there', async () => {
    const tribox = await load(), used = tribox.exports.malloc(4096);
    new Uint8Array(tribox.memory.buffer, used, 4096).fill(255);
    tribox.exports.free(used);
    assert.equal(tribox.mask(9 * COUNT).count(), 0);
});

test('voxels in the memory accumulate', async () => {
    const tribox = await load(), into = tribox.voxels(grid), halves = [positions.subarray(0, 4500), positions.subarray(4500)];
    const whole = tribox.soup({ positions }).voxelize(grid);
    assert.equal(into.count(), 0);
    for (const half of halves)
        assert.equal(tribox.soup({ positions: half }).voxelize(into, { into }), into);
    assert.deepEqual(into.bits, whole.bits);
    assert.equal(into.bits.buffer, tribox.memory.buffer);
});

test('voxels in the memory are filled, though it grows for that', async () => {
    const tribox = await load(), soup = tribox.soup({ positions }),
        fine = { origin: [-2, -2, -2], cell: 1 / 64, size: [256, 256, 256] };
    const into = soup.voxelize(fine, { into: tribox.voxels(fine) }), own = soup.voxelize(fine), bytes = bytesOf(tribox);
    const { solid, inside } = into.fillOutside();
    assert.ok(bytesOf(tribox) > bytes);
    assert.deepEqual(solid.bits, own.fillOutside().solid.bits);
    assert.equal(solid.count(), own.count() + inside);
});

test('a grid of a resolution just holds the triangles', async () => {
    const tribox = await load(), scales = [1, 1e-30, 3e37, 7];
    for (const [k, scale] of scales.entries())
        for (const resolution of [1, 2, 37]) {
            const positions = Float64Array.from(randomPositions(10, k + 1), (number) => number * scale + (k === 3 ? 1000 : 0));
            const triangles = k % 2 ? tribox.mesh({ positions }) : tribox.soup({ positions: Float32Array.from(positions) });
            const bounds = triangles.bounds(), { lo, hi } = bounds, voxels = triangles.voxelize({ resolution });
            const { size, grid: { origin, cell } } = voxels, last = size.map((cells) => cells - 1), box = voxels.box(...last);
            const longest = [0, 1, 2].reduce((most, a) => (hi[a] - lo[a] > hi[most] - lo[most] ? a : most), 0);
            assert.deepEqual(origin, lo);
            assert.equal(size[longest], resolution);
            const nearest = (hi[longest] - lo[longest]) / resolution;
            assert.ok(cell[0] >= nearest && cell[0] <= nearest * (1 + 2 ** -50));
            for (let a = 0; a < 3; a++) {
                assert.equal(cell[a], cell[0]);
                assert.ok(box.hi[a] >= hi[a] && (size[a] === 1 || box.lo[a] < hi[a]));
            }
            assert.ok(voxels.count() > 0);
            assert.deepEqual(tribox.gridAround(bounds, { resolution }), voxels.grid);
            assert.deepEqual(triangles.voxelize({ cell }).grid, voxels.grid);
        }
});

test('a brick after another', async () => {
    const tribox = await load(), soup = tribox.soup({ positions }), places = [], tiles = { side: 8 };
    const all = soup.bricks({ resolution: 40 }, tiles, (at, bits) => places.push([...at, ...bits]));
    assert.ok(places.length > 100 && !all.stopped);
    let calls = 0;
    const some = soup.bricks(all.grid, tiles, () => ++calls < 5);
    assert.equal(calls, 5);
    assert.ok(some.stopped && some.overlapping > 0 && some.overlapping < all.overlapping);
    assert.throws(() => soup.bricks(all.grid, tiles, () => {
        throw new RangeError('mine');
    }), /^RangeError: mine$/);
    const nested = [];
    soup.bricks(all.grid, tiles, (at, bits) => {
        soup.voxelize({ resolution: 3 }, { accuracy: 'fast', axes: ['box'] });
        soup.bricks({ resolution: 9 }, { side: 16 }, () => false);
        if (nested.length === 3)
            grow(tribox);
        nested.push([...at, ...bits]);
        return nested.length < 20;
    });
    assert.deepEqual(nested, places.slice(0, 20));
});

test('bounds leave out triangles that are not finite', async () => {
    const tribox = await load(), three = Float32Array.of(
        0, 1, 2, 3, 4, 5, 6, 7, 8, -90, 1, 1, 1, NaN, 1, 1, 1, 1, 9, 9, 9, 9, 9, -Infinity, 9, 99, 9);
    assert.deepEqual(tribox.soup({ positions: three }).bounds(), { lo: [0, 1, 2], hi: [6, 7, 8] });
    assert.equal(tribox.soup({ positions: three.subarray(9) }).bounds(), null);
    assert.throws(() => tribox.soup({ positions: three.subarray(9) }).voxelize({ resolution: 3 }), RangeError);
    assert.equal(tribox.soup({ positions: new Float32Array() }).bounds(), null);
});

test('nothing at all is a soup, a mesh, a mask', async () => {
    const tribox = await load(), soup = tribox.soup({ positions: new Float32Array() }, { sort: true }), index = soup.index();
    const empty = { overlapping: 0, undecided: 0, inside: 0 };
    for (const asked of [soup, index, tribox.mesh({ positions: new Float64Array() }), tribox.allocSoup(0)]) {
        const { mask, insideMask, ...counts } = asked.classify(middleBox);
        assert.deepEqual(counts, empty);
        assert.deepEqual([mask.length, mask.words.length, insideMask.count(), asked.count(middleBox)], [0, 0, 0, 0]);
    }
    assert.deepEqual([soup.find(middleBox), soup.find(middleBox, { what: 'miss' }), index.any(middleBox)], [-1, -1, -1]);
    const mesh = tribox.mesh({ positions: new Float64Array(), indices: new Uint16Array() }, { sort: true }), { starts, list } =
        mesh.tileLists(grid, { side: 4 });
    assert.deepEqual([mesh.ids.length, starts.length, list.length, mesh.index().any(oriented)], [0, 9, 0, -1]);
    assert.deepEqual(mesh.bricks(grid, { side: 8 }, assert.fail).overlapping, 0);
    assert.equal(mesh.voxelize(grid, { window: { first: [8, 0, 0], size: [0, 4, 4] } }).fillOutside().inside, 0);
    assert.equal(index.list(middleBox).length, 0);
    const none = { window: { first: [8, 8, 8], size: [0, 0, 0] } };
    assert.deepEqual([...index.lists([]).starts, ...soup.cellLists(grid, none).starts], [0, 0]);
    assert.deepEqual([soup.voxelize(grid).count(), soup.voxelize(grid).ids], [0, null]);
    assert.equal(tribox.mask(0).list().length, 0);
});

test('soups and grids of every small size', async () => {
    const tribox = await load(), all = Array.from(tribox.soup({ positions }).overlap(middleBox).mask.list());
    for (const length of [...Array(67).keys()].slice(1).concat(95, 96, 97, 127, 128, 129, 192, 193)) {
        const soup = tribox.soup({ positions: positions.subarray(0, 9 * length) }), index = soup.index(),
            into = tribox.mask(length);
        const expected = all.filter((i) => i < length), mesh = tribox.mesh({ positions: positions.subarray(0, 9 * length) });
        for (const asked of [soup, index, mesh]) {
            const { mask } = asked.overlap(middleBox), { insideMask } = asked.classify(middleBox, { into });
            assert.deepEqual([mask, into, insideMask].map(({ words }) => words.length), Array(3).fill(2 * Math.ceil(length / 64)));
            assert.deepEqual(Array.from(mask.list()), expected);
            assert.deepEqual(Array.from(into.list()), expected);
        }
        const size = [length, 2, 3], voxels = soup.voxelize({ origin: [-2, -2, -2], cell: [4 / length, 2, 1.5], size });
        assert.equal(voxels.rowWords, 2 * Math.ceil(length / 64));
        assert.equal(voxels.bits.length, 6 * voxels.rowWords);
        const cells = Array.from(voxels.list());
        assert.ok(cells.length > 0 && cells.every((number, k) => number < size[k % 3]));
        [soup, index, into, mesh].forEach((object) => object.free());
    }
});

test('an index is brought up to date', async () => {
    const tribox = await load(), soup = tribox.soup({ positions }), index = soup.index();
    const far = { lo: [99, 99, 99], hi: [101, 101, 101] };
    for (const place of [0, 63, 64, 500, COUNT - 1]) {
        assert.equal(index.any(far), -1);
        const old = ['x', 'y', 'z'].map((axis) => soup[axis][0][place]);
        for (const axis of ['x', 'y', 'z'])
            soup[axis][0][place] = 100;
        index.update(place, 1);
        assert.deepEqual(Array.from(index.list(far)), [place]);
        ['x', 'y', 'z'].forEach((axis, a) => {
            soup[axis][0][place] = old[a];
        });
        index.update();
    }
});

/** An instance with one of each thing in its memory. */
async function furnished() {
    const tribox = await load(), soup = tribox.soup({ positions }, { sort: true });
    return { tribox, soup, index: soup.index(), mesh: tribox.mesh({ positions }), mask: tribox.mask(COUNT),
        voxels: tribox.voxels(grid) };
}

/** Calls of each that take memory, and others; those of an index need its soup. */
const taking = {
    tribox: [({ tribox }) => tribox.soup({ positions }), ({ tribox }) => tribox.soup({ positions }, { sort: true }),
        ({ tribox }) => tribox.allocSoup(COUNT), ({ tribox }) => tribox.mesh({ positions }), ({ tribox }) => tribox.mask(COUNT),
        ({ tribox }) => tribox.mesh({ positions }, { sort: true }), ({ tribox }) => tribox.voxels(grid)],
    soup: [({ soup }) => soup.overlap(middleBox), ({ soup }) => soup.overlap(oriented), ({ soup }) => soup.classify(middleBox),
        ({ soup }) => soup.voxelize(grid), ({ soup }) => soup.voxelize({ resolution: 5 }),
        ({ soup }) => soup.voxelize(grid, { ids: true }),
        ({ soup }) => soup.index(), ({ soup }) => soup.cellLists(grid), ({ soup }) => soup.tileLists(grid, { side: 2 }),
        ({ soup }) => soup.bricks(grid, { side: 8 }, () => false), ({ soup, voxels }) => soup.fillParity(voxels),
        ({ soup }) => soup.split(middleBox), ({ index }) => index.list(middleBox, { ids: true }),
        ({ index }) => index.list(oriented),
        ({ index }) => index.lists([middleBox]), ({ index }) => index.classify(middleBox), ({ index }) => index.overlap(middleBox)],
    voxels: [({ voxels }) => voxels.fillOutside()],
};
const resting = [({ soup }) => soup.x, ({ soup }) => soup.ids, ({ soup }) => soup.address, ({ soup }) => soup.count(oriented),
    ({ soup }) => soup.find(middleBox), ({ soup }) => soup.bounds(), ({ index }) => index.update(),
    ({ index }) => index.any(middleBox)];

test('what is freed says so', async () => {
    const all = await furnished(), { tribox, soup, index, mesh, mask, voxels } = all, own = soup.overlap(middleBox).mask;
    const refused = (name, ...calls) => calls.forEach((call) =>
        assert.throws(() => call(all), { name: 'TriboxError', message: `this ${name} was freed` }, String(call)));
    soup.free();
    soup.free();
    refused('soup', ...taking.soup, ...resting);
    index.free();
    refused('index', () => index.any(middleBox));
    mesh[Symbol.dispose]();
    refused('mesh', () => mesh.positions, () => mesh.find(middleBox));
    mask.free();
    const other = tribox.soup({ positions });
    refused('mask', () => mask.words, () => other.overlap(middleBox, { into: mask }));
    voxels.free();
    refused('set of voxels', () => voxels.has(0, 0, 0), () => other.voxelize(grid, { into: voxels }), ...taking.voxels);
    assert.equal(own.count(), other.count(middleBox), 'a mask of the caller outlives its soup');
    own.free();
    refused('mask', () => own.list());
});

test('calls leave nothing behind in the memory', async () => {
    const all = await furnished(), { tribox, soup, mesh, voxels } = all, { tribox: made, ...others } = taking;
    const round = () => {
        made.forEach((call) => call(all).free());
        Object.values(others).flat().concat(resting).forEach((call) => {
            const answer = call(all);
            if (answer?.triangles === soup)
                answer.free();
        });
        assert.throws(() => mesh.split(middleBox, { list: [COUNT] }));
        assert.throws(() => soup.overlap(middleBox, { into: tribox }));
        assert.throws(() => soup.voxelize({ ...grid, cell: 1e-18, origin: [1, 1, 1] }));
        assert.throws(() => soup.bricks(grid, { side: 8 }, () => assert.fail()));
        soup.voxelize(voxels, { into: voxels });
        mesh.fillParity(voxels);
        mesh.tileLists(grid, { side: 2 });
    };
    round();
    const bytes = bytesOf(tribox);
    for (let k = 0; k < 300; k++)
        round();
    assert.equal(bytesOf(tribox), bytes);
});

test('out of memory is an error, after which there is as much as before', async () => {
    const all = await furnished(), { tribox, soup, index } = all, calls = Object.values(taking).flat(), taken = exhaust(tribox);
    for (const call of calls)
        assert.throws(() => call(all), ({ name, message }) => name === 'TriboxError' &&
            /^out of memory: .* would take .* free\(\)/.test(message), String(call));
    resting.forEach((call) => call(all));
    assert.equal(soup.count(middleBox), index.count(middleBox), 'what takes no memory goes on');
    taken.forEach((address) => tribox.exports.free(address));
    calls.forEach((call) => call(all));
    for (const length of [2 ** 26, 2 ** 31, 2 ** 32 - 1])
        assert.throws(() => tribox.allocSoup(length), TriboxError, `${length} triangles`);
    assert.throws(() => tribox.voxels({ origin: [0, 0, 0], cell: 1, size: [2 ** 17, 2 ** 17, 2 ** 17] }), /out of memory|grid/);
});

test('calls with into take no memory, nor do counts and places', async () => {
    const tribox = await load(), soup = tribox.soup({ positions }), index = soup.index(), mesh = tribox.mesh({ positions });
    const into = tribox.mask(COUNT), insideInto = tribox.mask(COUNT), cells = tribox.voxels(grid), own = soup.classify(middleBox);
    const expected = [own.mask.words, own.insideMask.words, own.inside, own.overlapping];
    exhaust(tribox);
    for (const asked of [soup, index, mesh]) {
        assert.throws(() => asked.classify(middleBox, { into }), /^TriboxError: out of memory: a mask/);
        into.words.fill(~0);
        insideInto.words.fill(~0);
        const classes = asked.classify(middleBox, { into, insideInto });
        assert.ok(classes.mask === into && classes.insideMask === insideInto && into.words.buffer === tribox.memory.buffer);
        assert.deepEqual([into.words, insideInto.words, classes.inside, asked.count(middleBox)], expected);
        asked.classify({ lo: [90, 90, 90], hi: [91, 91, 91] }, { into, insideInto });
        assert.ok([...into.words, ...insideInto.words].every((word) => word === 0), 'a box beside all of them leaves no bit');
        into.words.fill(~0);
        assert.equal(asked.overlap(middleBox, { into }).overlapping, own.overlapping);
        assert.deepEqual(into.words, own.mask.words);
    }
    for (const asked of [soup, index, mesh])
        assert.ok(asked.overlap(oriented, { into }).overlapping > 0);
    for (const asked of [soup, mesh])
        assert.deepEqual(['hit', 'miss'].map((what) => asked.find(middleBox, { what })), [soup.find(middleBox), soup.find(middleBox,
            { what: 'miss' })]);
    assert.ok(index.any(middleBox) >= 0);
    assert.ok(soup.voxelize(cells, { into: cells }).count() > 0);
    index.update();
    assert.throws(() => index.list(middleBox), TriboxError);
});

test('addresses beyond 2 GiB serve', async () => {
    const tribox = await load(), low = tribox.soup({ positions }), { exports } = tribox;
    while (exports.malloc(2 ** 20) >= 0);
    const high = tribox.soup({ positions }, { sort: true }), index = high.index(), into = tribox.mask(COUNT);
    const mesh = tribox.mesh({ positions }), voxels = low.voxelize(grid), counted = [];
    assert.ok(high.address > 2 ** 31);
    assert.deepEqual(mesh.fillParity(voxels).solid.bits, low.fillParity(voxels).solid.bits);
    assert.deepEqual(high.voxelize(grid).fillOutside().solid.bits, voxels.fillOutside().solid.bits);
    assert.equal(high.bricks(grid, { side: 8 }, (at) => counted.push(at)).overlapping, voxels.count());
    assert.deepEqual(counted, [[0, 0, 0]]);
    assert.deepEqual(mesh.index().list(oriented), mesh.overlap(oriented).mask.list());
    assert.deepEqual(Array.from(index.list(middleBox, { ids: true })).sort((i, j) => i - j),
        Array.from(low.overlap(middleBox).mask.list()));
    assert.deepEqual(mesh.overlap(middleBox, { into }).mask.words, low.overlap(middleBox).mask.words);
    assert.deepEqual(high.voxelize(grid, { into: tribox.voxels(grid) }).bits, low.voxelize(grid).bits);
    [high, index, into, mesh].forEach((object) => object.free());
});

test('sorting that runs out of memory gives back what it took', async () => {
    const tribox = await load(), { exports } = tribox, small = { positions: positions.subarray(0, 9 * 800) };
    // Two soups of 29 KB fit into it, but not what sorting takes besides.
    const hole = exports.malloc(66000);
    exhaust(tribox);
    exports.free(hole);
    for (let k = 0; k < 3; k++)
        assert.throws(() => tribox.soup(small, { sort: true }), { name: 'TriboxError', message: /^out of memory: sorting a soup/ });
    assert.notEqual(exports.malloc(65000), 0);
});

test('instances know nothing of each other', async () => {
    const [one, other] = await Promise.all([load(), load()]);
    const soup = one.soup({ positions });
    assert.throws(() => soup.overlap(middleBox, { into: other.mask(COUNT) }), TypeError);
    assert.throws(() => soup.voxelize(grid, { into: other.voxels(grid) }), TypeError);
    assert.deepEqual(soup.overlap(middleBox).mask.words, other.soup({ positions }).overlap(middleBox).mask.words);
    assert.notEqual(one.memory, other.memory);
});

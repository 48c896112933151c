// arguments.test.mjs - bad arguments are refused by a line that says which one, what is wrong and what to do; nothing changes.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load, middleBox as box, randomPositions, TriboxError } from './package_under_test.mjs';

const tribox = await load();
const positions = randomPositions(100), soup = tribox.soup({ positions }), index = soup.index();
const mesh = tribox.mesh({ positions: Float64Array.from(positions) });
const mask = tribox.mask(100), grid = { origin: [0, 0, 0], cell: 1, size: [4, 4, 4] }, voxels = tribox.voxels(grid);
const axis = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], oriented = { center: [0, 0, 0], half: [1, 1, 1], axis };

/** [call, the error's class, its message] */
const wrong = {
    'boxes': [
        [() => soup.overlap(), TypeError, /^box = undefined: give \{lo: /],
        [() => soup.overlap(7), TypeError, /^box = 7: give/],
        [() => soup.overlap({}), TypeError, /^box = an empty object: give/],
        [() => soup.count({ lo: [0, 0, 0] }), TypeError, /^box = an object with lo: give/],
        [() => soup.classify({ lo: [0, 0, 0], max: [1, 1, 1] }), TypeError, /^box = an object with lo, max: give/],
        [() => soup.find({ lo: [0, 0], hi: [1, 1, 1] }), TypeError, /^box\.lo = \[0, 0\]: give three numbers/],
        [() => soup.find({ lo: [0, 0, 0], hi: ['1', 1, 1] }), TypeError, /^box\.hi = \["1", 1, 1\]: give three numbers/],
        [() => soup.overlap({ min: { x: 0, y: 0 }, max: [1, 1, 1] }), TypeError, /^box\.min = an object with x, y: give three/],
        [() => soup.overlap({ lo: [0, NaN, 0], hi: [1, 1, 1] }), RangeError, /^box\.lo: y is NaN; give finite/],
        [() => index.any({ lo: [0, 0, 0], hi: [1, 1, Infinity] }), RangeError, /^box\.hi: z is Infinity; give finite/],
    ],
    'oriented boxes': [
        [() => soup.overlap({ ...oriented, axis: undefined }), TypeError, /^box\.axis = undefined: give the directions/],
        [() => soup.overlap({ ...oriented, axis: axis.slice(1) }), TypeError, /^box\.axis = \[\[0, 1, 0\], \[0, 0, 1\]\]: give/],
        [() => soup.overlap({ ...oriented, axis: [axis[0], axis[1], [1, 2]] }), TypeError, /^box\.axis\[2\] = \[1, 2\]: give/],
        [() => index.list({ ...oriented, half: [1, 1, -Infinity] }), RangeError, /^box\.half: z is -Infinity/],
        [() => index.count({ ...oriented, center: 1 }), TypeError, /^box\.center = 1: give/],
        [() => soup.classify(oriented), TypeError, /^box is oriented, which this call does not take/],
        [() => mesh.find(oriented), TypeError, /^box is oriented/],
        [() => index.classify(oriented), TypeError, /^box is oriented/],
        [() => soup.overlap(oriented, { axes: ['box', 'plane'] }), RangeError, /^options\.axes: .*oriented.*'box'/],
    ],
    'options': [
        [() => soup.overlap(box, 7), TypeError, /^options = 7: give an object/],
        [() => soup.overlap(box, null), TypeError, /^options = null: give an object/],
        [() => soup.overlap(box, { acuracy: 'fast' }), TypeError,
            /^options\.acuracy is unknown; there are accuracy, axes, axisOrder, into$/],
        [() => soup.count(box, { into: mask }), TypeError, /^options\.into is unknown; there are accuracy, axes, axisOrder$/],
        [() => index.list(box, { id: true }), TypeError, /^options\.id is unknown; there are accuracy, axes, axisOrder, ids$/],
        [() => soup.overlap(box, { accuracy: 'Exact' }), RangeError, /^options\.accuracy = "Exact": give one of "exact", "cons/],
        [() => soup.overlap(box, { axes: 'box' }), TypeError, /^options\.axes = "box": give a list of groups/],
        [() => soup.overlap(box, { axes: [] }), TypeError, /^options\.axes = \[\]: give a list of groups/],
        [() => soup.overlap(box, { axes: ['box', 'edge'] }), RangeError,
            /^options\.axes = "edge": give one of "box", "plane", "edges"/],
        [() => soup.overlap(box, { axes: ['toString'] }), RangeError, /^options\.axes = "toString": give one of/],
        [() => soup.overlap(box, { axisOrder: '123' }), RangeError, /^options\.axisOrder = "123": give one of 123, 132/],
        [() => soup.find(box, { what: 'all' }), RangeError, /^options\.what = "all": give one of "hit", "miss"/],
        [() => soup.split(box, { axes: ['plane'] }), RangeError, /^options\.axes: children take all groups or \['box'\]/],
        [() => soup.split(box, { middle: [9, 0, 0] }), RangeError, /^options\.middle = \[9, 0, 0\] is outside the box/],
        [() => soup.split(box, { list: 7 }), TypeError, /^options\.list = 7: give the numbers of triangles/],
        [() => mesh.split(box, { list: [5, 100] }), RangeError, /^options\.list\[1\] = 100: give a whole number from 0 to 99/],
        [() => soup.split(oriented), TypeError, /^box is oriented/],
        [() => index.overlap(box, { axes: ['plane'] }), RangeError, /^options\.axes: .*index.*'box'/],
        [() => soup.overlap(box, { into: new Uint32Array(4) }), TypeError,
            /^options\.into: give a mask that tribox\.mask\(100\) made/],
        [() => soup.overlap(box, { into: tribox.mask(99) }), RangeError, /^options\.into has 99 bits: give one of 100/],
        [() => soup.overlap(box, { into: soup.overlap(box).mask }), TypeError, /^options\.into is not in the memory/],
        [() => soup.classify(box, { insideInto: tribox.mask(101) }), RangeError, /^options\.insideInto has 101 bits/],
        [() => soup.classify(box, { into: mask, insideInto: mask }), TypeError,
            /^options\.insideInto is the mask of options\.into/],
    ],
    'soups and meshes': [
        [() => tribox.soup(), TypeError, /^mesh = undefined: give \{positions, indices\}/],
        [() => tribox.soup(positions), TypeError, /^mesh\.positions = undefined: give a Float32Array/],
        [() => tribox.soup({ positions: [1, 2, 3] }), TypeError, /^mesh\.positions = \[1, 2, 3\]: give a Float32Array/],
        [() => tribox.soup({ positions: new Float64Array(9) }), TypeError,
            /a Float64Array of 9: a soup has floats; mesh\(\) takes/],
        [() => tribox.mesh({ positions: new Int32Array(9) }), TypeError,
            /an? Int32Array of 9: give a Float64Array or a Float32Array/],
        [() => tribox.soup({ positions: new Float32Array(12) }), RangeError,
            /^mesh\.positions has 12 numbers: give nine a triangle/],
        [() => tribox.soup({ positions: new Float32Array(10), indices: new Uint32Array(3) }), RangeError,
            /10 numbers: give three a vert/],
        [() => tribox.soup({ positions, indices: [0, 1, 2] }), TypeError, /^mesh\.indices = \[0, 1, 2\]: give a Uint32Array or a/],
        [() => tribox.soup({ positions, indices: new Int32Array(3) }), TypeError, /^mesh\.indices = an? Int32Array of 3: give/],
        [() => tribox.soup({ positions, indices: new Uint32Array(4) }), RangeError, /^mesh\.indices has 4 numbers: give three/],
        [() => tribox.mesh({ positions, indices: Uint16Array.of(0, 1, 300) }), RangeError,
            /^mesh\.indices\[2\] = 300: the mesh has 300 vertices, numbered from 0/],
        [() => tribox.soup({ positions: new Float32Array(), indices: Uint32Array.of(0, 0, 0) }), RangeError, /has 0 vertices/],
        [() => tribox.soup({ positions }, { sorted: true }), TypeError, /^options\.sorted is unknown; there are sort$/],
        [() => tribox.allocSoup(-1), RangeError, /^length = -1: give a whole number from 0/],
        [() => tribox.mask('100'), TypeError, /^length = "100": give a whole number/],
    ],
    'places': [
        [() => mask.has(100), RangeError, /^i = 100: give a whole number from 0 to 99/],
        [() => voxels.has(0, 4, 0), RangeError, /^j = 4: give a whole number from 0 to 3/],
        [() => voxels.has(0, 0), TypeError, /^k = undefined: give a whole number/],
        [() => voxels.box(4, 0, 0), RangeError, /^i = 4: give/],
        [() => index.update(101), RangeError, /^first = 101: give a whole number from 0 to 100/],
        [() => index.update(50, 51), RangeError, /^count = 51: give a whole number from 0 to 50, so that first \+ count is within/],
        [() => soup.tileLists(grid, { side: 1, first: 60, count: 5 }), RangeError,
            /^tiles\.count = 5: give a whole number from 0 to 4/],
        [() => soup.tileLists(grid, { side: 1, first: 65 }), RangeError, /^tiles\.first = 65: give/],
    ],
    'grids': [
        [() => soup.voxelize(), TypeError, /^grid = undefined: give \{resolution\}, \{cell\}, or \{origin, cell, size\}/],
        [() => soup.voxelize(64), TypeError, /^grid = 64: give/],
        [() => soup.voxelize({ resolution: 0 }), RangeError, /^grid\.resolution = 0: give a whole number from 1 to/],
        [() => soup.voxelize({ resolution: 4, cell: 2 }), TypeError, /^grid\.cell does not go with resolution: give \{re/],
        [() => soup.cellLists({ cell: 2, orign: [0, 0, 0] }), TypeError, /^grid\.orign does not go with cell: give/],
        [() => tribox.gridAround(box, { cell: 2, resolution: 4 }), TypeError, /^grid\.cell does not go with resolution: give/],
        [() => soup.voxelize({ ...grid, origin: [0, 0] }), TypeError, /^grid\.origin = \[0, 0\]: give three numbers/],
        [() => soup.voxelize({ ...grid, origin: [0, 0, NaN] }), RangeError, /^grid\.origin: z is NaN/],
        [() => soup.voxelize({ ...grid, cell: -0 }), RangeError, /^grid\.cell = -0: give lengths greater than 0/],
        [() => soup.voxelize({ ...grid, cell: [1, 1, -1] }), RangeError, /^grid\.cell = \[1, 1, -1\]: give lengths greater/],
        [() => soup.voxelize({ ...grid, cell: undefined }), TypeError, /^grid\.cell = undefined: give three numbers/],
        [() => tribox.voxels({ ...grid, size: [4, 0, 4] }), RangeError, /^grid\.size\[1\] = 0: give a whole number from 1 to/],
        [() => tribox.voxels({ ...grid, size: [4, 4, 2.5] }), RangeError, /^grid\.size\[2\] = 2\.5: give a whole number/],
        [() => soup.voxelize({ ...grid, origin: [1e17, 0, 0] }), RangeError,
            /^grid: doubles cannot tell its planes apart.*larger cells/],
        [() => tribox.voxels({ ...grid, cell: 1e308 }), RangeError, /^grid: .*beyond the largest/],
        [() => soup.voxelize(grid, { into: mask }), TypeError, /^options\.into: give voxels that tribox\.voxels\(grid\) made/],
        [() => soup.voxelize({ ...grid, cell: 2 }, { into: voxels }), RangeError, /^options\.into has another grid or window/],
        [() => soup.voxelize(grid, { into: voxels, window: { first: [1, 0, 0], size: [3, 4, 4] } }), RangeError,
            /^options\.into has another/],
        [() => soup.voxelize(grid, { into: tribox.voxels(grid, { first: [1, 0, 0], size: [3, 4, 4] }), window: { first: [0, 0, 0],
            size: [3, 4, 4] } }), RangeError, /^options\.into has another/],
        [() => soup.voxelize(grid, { window: 3 }), TypeError, /^window = 3: give \{first: /],
        [() => soup.voxelize(grid, { window: { first: [0, 5, 0], size: [1, 1, 1] } }), RangeError, /^window\.first\[1\] = 5: give/],
        [() => tribox.voxels(grid, { first: [0, 0, 1], size: [4, 4, 4] }), RangeError,
            /^window\.size\[2\] = 4: give .* to 3, so that/],
        [() => soup.voxelize({ cell: 1e-30 }), RangeError, /^grid: it would have more than 2\^32 cells/],
        [() => tribox.gridAround(box, grid), TypeError, /^grid = an object with origin, cell, size: give \{resolution\} or/],
        [() => soup.voxelize(grid, { into: soup.voxelize(grid) }), TypeError, /^options\.into is not in the memory/],
        [() => tribox.soup({ positions: new Float32Array(9).fill(3) }).voxelize({ resolution: 2 }), RangeError,
            /^all triangles lie in the point \[3, 3, 3\], which has no longest side: give \{origin, cell, size\}/],
        [() => tribox.soup({ positions: new Float32Array(9).fill(NaN) }).voxelize({ resolution: 2 }), RangeError,
            /no triangle with finite coordinates/],
    ],
    'what is in which cell': [
        [() => tribox.tileCount([1, 2], 8), TypeError, /^size = \[1, 2\]: give three numbers/],
        [() => tribox.tileCount([1, 2, -1], 8), RangeError, /^size\[2\] = -1: give/],
        [() => tribox.tileCount([1, 2, 3], 0), RangeError, /^side = 0: give/],
        [() => soup.voxelize(grid, { into: voxels, ids: true }), TypeError, /^options\.ids and options\.into/],
        [() => soup.voxelize(grid, { thin: true, ids: true }), TypeError, /^options\.ids and options\.thin/],
        [() => soup.voxelize(grid, { thin: true, accuracy: 'fast' }), TriboxError, /^tribox_voxelize_thin: an option/],
        [() => soup.cellLists(grid, { window: { first: [2, 0, 0], size: [3, 1, 1] } }), RangeError, /^window/],
        [() => soup.cellLists(grid, { ids: true }), TypeError, /^options\.ids is unknown/],
        [() => index.lists(box), TypeError, /^boxes = /],
        [() => index.lists([{ lo: [0, 0, 0] }]), TypeError, /^box = /],
    ],
    'tiles and fills': [
        [() => soup.tileLists(grid), TypeError, /^tiles = undefined: give \{side\}/],
        [() => soup.tileLists(grid, { side: 0 }), RangeError, /^tiles\.side = 0: give a whole number from 1/],
        [() => soup.bricks(grid, { side: 12 }, () => {}), RangeError, /^tiles\.side = 12: give a multiple of 8/],
        [() => soup.bricks(grid, { side: 1032 }, () => {}), RangeError, /^tiles\.side = 1032: give a whole number from 1 to 1024/],
        [() => soup.bricks(grid, { side: 8 }), TypeError, /^take = undefined: give a function/],
        [() => mesh.bricks({ ...grid, cell: 1e308 }, { side: 8 }, () => {}), RangeError, /^grid: doubles/],
        [() => soup.fillParity(grid), TypeError, /^voxels = an object with origin, cell, size: give those that voxelize made/],
        [() => mesh.fillParity(tribox.voxels(grid, { first: [1, 0, 0], size: [3, 4, 4] })), RangeError, /^voxels are of a window/],
    ],
};

for (const [name, cases] of Object.entries(wrong))
    test(name, () => {
        const written = () => [mask.words.slice(), voxels.bits.slice()], before = written();
        for (const [call, kind, message] of cases)
            assert.throws(call, (error) => {
                assert.equal(error.constructor, kind, `${call}: ${error.message}`);
                assert.match(error.message, message);
                assert.ok(!/\n|undefined is not|\[object/.test(error.message), error.message);
                return true;
            });
        assert.deepEqual(written(), before);
    });

test('boxes in other words are the same box', () => {
    const { words } = soup.overlap(box).mask, [x, y, z] = box.lo;
    for (const same of [
        { min: box.lo, max: box.hi },
        { min: { x, y, z }, max: { x: 0.5, y: 0.5, z: 0.5 } },
        { lo: Float32Array.from(box.lo), hi: Float64Array.from(box.hi) },
        Object.create(box),
    ])
        assert.deepEqual(soup.overlap(same).mask.words, words);
    assert.equal(soup.count({ lo: [1, 0, 0], hi: [-1, 1, 1] }), 0, 'the empty box');
    const none = { accuracy: undefined, axes: undefined, axisOrder: undefined, into: undefined };
    assert.equal(soup.overlap(box, none).mask.length, 100);
});

test('boxes are not rounded', () => {
    const float = Math.fround(1 / 3), single = { positions: new Float32Array(9).fill(1 / 3) };
    const point = (x) => ({ lo: [x, x, x], hi: [x, x, x] });
    for (const made of [tribox.soup(single), tribox.mesh(single), tribox.soup(single).index(), tribox.mesh(single).index()])
        assert.deepEqual([made.count(point(1 / 3)), made.count(point(float))], [0, 1]);
    assert.equal(tribox.mesh({ positions: new Float64Array(9).fill(1 / 3) }).count(point(1 / 3)), 1);
});

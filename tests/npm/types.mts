// types.mts - what TypeScript makes of the package: this compiles, and each line that is marked has its error.
import { load, TriboxError } from 'tribox';
import type { Box, Bricks, CellLists, Classes, Filled, Grid, Index, Lists, Mask, Mesh, Options, OrientedBox, Soup, TileLists, Tribox, Voxels, Window } from 'tribox';

const tribox: Tribox = await load(new URL('./tribox.wasm', import.meta.url));
const options: Options = { accuracy: 'conservative', axes: ['box', 'edges'], axisOrder: 312 };
const box: Box = { lo: [0, 0, 0], hi: new Float32Array(3) };
const oriented: OrientedBox = { center: [0, 0, 0], half: { x: 1, y: 1, z: 1 }, axis: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] };
const grid: Grid = { origin: [0, 0, 0], cell: 0.5, size: [4, 4, 4] };

function ask(soup: Soup): number {
    using index: Index = soup.index();
    const classes: Classes = soup.classify({ min: { x: 0, y: 0, z: 0 }, max: [1, 1, 1] }, { ...options, into: tribox.mask(soup.length) });
    const mask: Mask = index.overlap(oriented).mask, list: Uint32Array = index.list(box, { ids: true }), ids: Uint32Array | null = soup.ids;
    const voxels: Voxels = soup.voxelize({ resolution: 64 }, options);
    const window: Window = { first: [0, 0, 0], size: [2, 4, 4] };
    soup.voxelize(voxels, { into: tribox.voxels(grid) });
    soup.voxelize({ cell: 0.1 }, { window });
    soup.x[0].set(soup.y[2]);
    return classes.inside + mask.words.length + list.length + (ids?.length ?? 0) + voxels.bits.length + (soup.bounds()?.lo[0] ?? 0);
}

const positions = new Float32Array(9);
const soup = tribox.soup({ positions, indices: new Uint16Array(3) }, { sort: true });
const mesh: Mesh = tribox.mesh({ positions: new Float64Array(9), indices: null });
const sorted: Mesh = tribox.mesh({ positions }, { sort: true });
const lists: TileLists = sorted.tileLists(grid, { side: 1 }), set = new Map<string, Uint32Array>();
const bricks: Bricks = mesh.bricks({ resolution: 64 }, { side: 128, first: 0, count: 1 }, (at, bits) => set.set(at.join(), bits));
mesh.bricks(grid, { side: 64 }, (at, _, starts, triangles) => set.set(at.join(), triangles.slice(0, starts[1])), { lists: true });
const byCell: CellLists = mesh.cellLists({ cell: 0.5 }, { accuracy: 'exact' }), many: Lists = mesh.index().lists([box, oriented], { ids: true });
const children: Uint8Array = mesh.split(box, { middle: [0, 0, 0], list: byCell.list, accuracy: 'fast' });
const thin: Voxels = mesh.voxelize(grid, { thin: true });
const lowest: Uint32Array | null = mesh.voxelize(grid, { ids: true }).ids;
export const tiles: number = tribox.tileCount(grid.size, 8) + byCell.cells.length + many.list.length + (lowest?.length ?? 0) + thin.count() + children.length;
const filled: Filled = sorted.voxelize(grid).fillOutside(), odd: number = mesh.fillParity(filled.solid).oddRows;
const answer: number = ask(soup) + lists.list[0]! + bricks.overlapping + odd + mesh.index().any(oriented) + mesh.count(oriented) + tribox.exports.malloc!(8);
export const failure = answer > 0 ? new TriboxError('no', { cause: answer }) : null;

// @ts-expect-error a soup has floats
tribox.soup({ positions: new Float64Array(9) });
// @ts-expect-error three axes are asked for
soup.overlap({ ...oriented, axis: [[1, 0, 0]] });
// @ts-expect-error classify takes no oriented box
soup.classify(oriented);
// @ts-expect-error nor does find
mesh.find(oriented);
// @ts-expect-error the soup has find
soup.index().find(box);
// @ts-expect-error there is no such word
soup.find(box, { what: 'all' });
// @ts-expect-error bricks are of tiles
soup.bricks(grid, () => true);
// @ts-expect-error there is no such accuracy
soup.overlap(box, { accuracy: 'Exact' });
// @ts-expect-error there is no such option
soup.overlap(box, { kernel: 'scalar' });
// @ts-expect-error nor are there ids of boxes
soup.overlap(box, { ids: true });
// @ts-expect-error there is no such order
soup.overlap(box, { axisOrder: 111 });
// @ts-expect-error a mask is not writable as a whole
tribox.mask(8).words = new Uint32Array(2);
// @ts-expect-error nor is a soup made by hand
new Soup();

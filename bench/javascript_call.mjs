// javascript_call.mjs - what the npm package takes in node: node bench/javascript_call.mjs PACKAGE [TRIANGLES], the folder of the package.
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, triangles = '1000000'] = process.argv.slice(2), count = Number(triangles);
if (!folder || !Number.isInteger(count) || count < 1) {
    console.error('usage: node bench/javascript_call.mjs PACKAGE [TRIANGLES]; packaging/npm/build.sh PACKAGE makes it');
    process.exit(2);
}
const { load } = await import(pathToFileURL(path.resolve(folder, 'tribox.mjs')));
const tribox = await load();

const SECONDS = 2, FEW = 64;
const box = { lo: [-0.5, -0.5, -0.5], hi: [0.5, 0.5, 0.5] };

/** The paper's: vertices uniform in a cube of four times the side of the box. Mulberry32 draws them. */
function randomPositions() {
    let state = 1;
    return Float32Array.from({ length: 9 * count }, () => {
        state = state + 0x6d2b79f5 | 0;
        let bits = Math.imul(state ^ state >>> 15, state | 1);
        bits ^= bits + Math.imul(bits ^ bits >>> 7, bits | 61);
        return 4 * ((bits ^ bits >>> 14) >>> 0) / 2 ** 32 - 2;
    });
}

/** The least time of many, in milliseconds: the first ones run before the engine's best compiler is done. */
function least(work) {
    let best = Infinity;
    for (const end = performance.now() + 1000 * SECONDS; performance.now() < end;) {
        const start = performance.now();
        work();
        best = Math.min(best, performance.now() - start);
    }
    return best;
}

const perTriangle = (what, work) => console.log(`${what.padEnd(34)} ${(1e6 * least(work) / count).toFixed(2).padStart(8)} ns a triangle`);

const positions = randomPositions();
console.log(`kernel ${tribox.kernel}, ${count} triangles, node ${process.version}`);
perTriangle('soup({positions})', () => tribox.soup({ positions }).free());
const soup = tribox.soup({ positions }), into = tribox.mask(count), insideInto = tribox.mask(count);
for (const accuracy of ['fast', 'conservative', 'exact'])
    perTriangle(`overlap into a mask, ${accuracy}`, () => soup.overlap(box, { accuracy, into }));
perTriangle('overlap, exact', () => soup.overlap(box));
perTriangle('classify into masks, exact', () => soup.classify(box, { into, insideInto }));

const few = tribox.soup({ positions: positions.subarray(0, 9 * Math.min(FEW, count)) }), fewInto = tribox.mask(few.length), CALLS = 1000;
const calls = least(() => {
    for (let k = 0; k < CALLS; k++)
        few.overlap(box, { into: fewInto });
});
console.log(`${`overlap of ${few.length} triangles`.padEnd(34)} ${(1000 * calls / CALLS).toFixed(2).padStart(8)} us a call`);

// package_under_test.mjs - the package that was built, and what its tests share.
import path from 'node:path';
import { pathToFileURL } from 'node:url';

export const folder = process.env.TRIBOX_PACKAGE;

export const { load, TriboxError } = await import(pathToFileURL(path.join(folder, 'tribox.mjs')));

/** Numbers that are the same every time: from 0 to below 1, by Marsaglia's xorshift of 32 bits. */
export function drawing(seed) {
    let state = seed | 1;
    return () => {
        state ^= state << 13;
        state ^= state >>> 17;
        state ^= state << 5;
        return (state >>> 0) / 2 ** 32;
    };
}

/** So many triangles with vertices in the cube from -2 to 2, as in the paper. */
export function randomPositions(count, seed = 1) {
    const draw = drawing(seed);
    return Float32Array.from({ length: 9 * count }, () => 4 * draw() - 2);
}

export const middleBox = { lo: [-0.5, -0.5, -0.5], hi: [0.5, 0.5, 0.5] };

// test_cells.mjs - cells of grids and triangles unlike EXACT are the program's.
import assert from 'node:assert/strict';
import { listFaces } from '../../examples/web/src/view/face_list.js';
import { answerOf, ask, settled } from './answer.mjs';
import { openPage, usualPage } from './browser.mjs';
import { coarseFile, tiesFile } from './meshes.mjs';

async function cellsAt(page, resolution) {
    await page.fill('#resolution', String(resolution));
    await page.waitForFunction((n) => {
        const note = document.getElementById('cells-note').textContent;
        return document.getElementById('resolution-value').value === n && note.includes(' of ') && note.includes(`${n} ×`);
    }, String(resolution));
    return (await page.textContent('#cells-note'))
        .match(/^([\d,]+) of (\d+) × (\d+) × (\d+) cells/).slice(1).map((n) => Number(n.replaceAll(',', '')));
}

export async function countsAreThePrograms() {
    const page = await usualPage();
    for (const resolution of [64, 5, 100]) {
        const [count, ...size] = await cellsAt(page, resolution);
        const said = ask(['voxelize', 'MESH', '--resolution', String(resolution), '--count'], coarseFile);
        assert.deepEqual([size, count], [said.grid.size, said.occupied]);
    }
    await page.uncheck('#cells');
    await page.waitForFunction(() => document.getElementById('cells-note').textContent.startsWith('Every cell'));
}

/** Random cells of 70 x 5 x 3, in rows of four words: each face once, and those alone that have no cell beside them. */
export function facesAreListed() {
    const size = [70, 5, 3], bits = new Uint32Array(4 * 15), cells = [], faces = [];
    const has = ([i, j, k]) =>
        [i, j, k].every((c, a) => c >= 0 && c < size[a]) && ((bits[(k * 5 + j) * 4 + (i >> 5)] >>> (i & 31)) & 1) === 1;
    for (let n = 0, random = 1; n < 1050; n++) {
        random = (Math.imul(random, 1103515245) + 12345) >>> 0;
        const cell = [n % 70, Math.floor(n / 70) % 5, Math.floor(n / 350)];
        if ((random >>> 16) % 3 === 0) continue;
        cells.push(cell);
        bits[(cell[2] * 5 + cell[1]) * 4 + (cell[0] >> 5)] |= 1 << (cell[0] & 31);
    }
    for (const cell of cells)
        for (let side = 0; side < 6; side++) {
            const beside = cell.slice();
            beside[side >> 1] += 2 * (side & 1) - 1;
            if (!has(beside)) faces.push([...cell, side].join());
        }
    const { at, ...found } = listFaces(size, bits, 2000);
    assert.deepEqual(found, { faces: faces.length, count: cells.length });
    const listed = Array.from({ length: found.faces }, (_, f) => at.slice(4 * f, 4 * f + 4).join());
    assert.deepEqual(listed.sort(), faces.sort());
    const fewer = listFaces(size, bits, faces.length - 1);
    assert.deepEqual([fewer.at.length, fewer.faces], [0, faces.length], 'some of the faces are drawn, and not all');
}

export async function unlikeExact() {
    const page = await openPage({ query: '?scene=ties' });
    for (const accuracy of ['fast', 'conservative']) {
        await page.click(`#accuracy [value=${accuracy}]`);
        await page.waitForFunction(
            (word) => document.getElementById('unlike-title').textContent.startsWith(word.toUpperCase()),
            accuracy,
        );
        await settled(page);
        const answer = await answerOf(page), words = answer.command.split(' ').slice(1).filter((word) => word !== '--inside');
        const list = (more) => ask([...words, '--list', ...more], tiesFile).indices;
        const theirs = new Set(list(['--kernel', 'scalar'])),
            exact = new Set(ask([...words.slice(0, 3), '--list'], tiesFile).indices);
        const unlike = Array.from({ length: 600 }, (_, i) => i).filter((i) => theirs.has(i) !== exact.has(i));
        assert.deepEqual(answer.numbers, unlike, accuracy);
        assert.equal(answer.unlike, unlike.length);
        assert.ok(accuracy !== 'fast' || unlike.length > 100, `only ${unlike.length} triangles differ`);
    }
    await page.click('#accuracy [value=fast]');
    await page.waitForFunction(() => document.getElementById('unlike-title').textContent.startsWith('FAST'));
    const { numbers } = await answerOf(page);
    await page.check('#by-index');
    await page.waitForFunction(() => document.getElementById('rate').textContent.startsWith('by the index'));
    assert.deepEqual((await answerOf(page)).numbers, numbers, 'by the index');
    await page.click('#accuracy [value=exact]');
    await page.waitForFunction(() => document.getElementById('unlike-list').hidden);
}

export async function chart() {
    const page = await usualPage();
    await page.click('#measure');
    await page.waitForSelector('.bars', { timeout: 20000 });
    const rows = await page.$$eval('.bars dd', (all) =>
        all.map((row) => [row.className, Number(row.querySelector('b').textContent)]),
    );
    assert.deepEqual(rows.map(([name]) => name), ['paper', 'exact']);
    assert.ok(rows.every(([, ns]) => ns > 0.1 && ns < 10000), JSON.stringify(rows));
    assert.equal(await page.textContent('#measure'), 'Measure');
}

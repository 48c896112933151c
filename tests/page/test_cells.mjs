// test_cells.mjs - cells of grids and triangles unlike EXACT are the program's.
import assert from 'node:assert/strict';
import { listCells } from '../../examples/web/src/view/cell_list.js';
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
        .match(/^([\d,]+) of (\d+) × (\d+) × (\d+) cells/)
        .slice(1)
        .map((n) => Number(n.replaceAll(',', '')));
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

/** 70 x 3 x 2 cells, in rows of four words. */
export function cellsAreListed() {
    const size = [70, 3, 2],
        bits = new Uint32Array(24);
    const cells = [
        [31, 0, 0],
        [32, 2, 0],
        [69, 2, 0],
        [0, 0, 1],
        [5, 1, 1],
    ];
    for (const [i, j, k] of cells) bits[(k * 3 + j) * 4 + (i >> 5)] |= 1 << (i & 31);
    assert.deepEqual(listCells(size, bits, 9), { at: Uint16Array.from(cells.flat()), count: 5, drawn: 5 });
    assert.deepEqual(listCells(size, bits, 2), { at: Uint16Array.from(cells.slice(0, 2).flat()), count: 5, drawn: 2 });
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
        const answer = await answerOf(page),
            words = answer.command
                .split(' ')
                .slice(1)
                .filter((word) => word !== '--inside');
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
    assert.deepEqual(
        rows.map(([name]) => name),
        ['paper', 'fast', 'conservative', 'exact'],
    );
    assert.ok(
        rows.every(([, ns]) => ns > 0.1 && ns < 10000),
        JSON.stringify(rows),
    );
    assert.equal(await page.textContent('#measure'), 'Measure');
}

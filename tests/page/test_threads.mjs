// test_threads.mjs - Workers: two wherever there are two processors, one where one is asked for; the answers are the same.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { answerAfter, answerOf, assertSame } from './answer.mjs';
import { openPage } from './browser.mjs';
import { coarseFile } from './meshes.mjs';

const isolated = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** Runs work(url) while the page is served. */
async function served(areHeadersWanted, work) {
    const page = await readFile(process.env.PAGE);
    const server = createServer((request, response) => {
        response.writeHead(200, { 'Content-Type': 'text/html; charset=utf-8', ...(areHeadersWanted && isolated) });
        response.end(page);
    });
    await new Promise((go) => server.listen(0, '127.0.0.1', go));
    try {
        await work(`http://127.0.0.1:${server.address().port}/`);
    } finally {
        server.close();
        server.closeAllConnections();
    }
}

async function assertWorkers(page, count) {
    assert.equal(page.workers().length, count);
    assertSame(await answerOf(page), coarseFile);
    await page.focus('#canvas');
    assertSame(await answerAfter(page, () => page.keyboard.press('ArrowUp')), coarseFile);
}

const most = (page) => page.evaluate(() => Math.min(2, navigator.hardwareConcurrency));

export async function fromAFolder() {
    const page = await openPage();
    await assertWorkers(page, await most(page));
}

export async function overHttp() {
    for (const isIsolated of [true, false])
        await served(isIsolated, async (url) => {
            const page = await openPage({ url });
            assert.equal(await page.evaluate(() => crossOriginIsolated), isIsolated);
            await assertWorkers(page, await most(page));
        });
}

export async function oneAndFive() {
    for (const count of [1, 5]) await assertWorkers(await openPage({ query: `?scene=coarse&workers=${count}` }), count);
}

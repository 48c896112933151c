// test_threads.mjs - Workers: two wherever there are two processors, one where one is asked for; the answers are the same.
import assert from 'node:assert/strict';
import { answerAfter, answerOf, assertSame } from './answer.mjs';
import { openPage } from './browser.mjs';
import { coarseFile } from './meshes.mjs';
import { served } from './serve.mjs';

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

export async function withHeaders() {
    await served(true, async (url) => {
        const page = await openPage({ url });
        assert.equal(await page.evaluate(() => crossOriginIsolated), true);
        await assertWorkers(page, await most(page));
    });
}

export async function withoutHeaders() {
    await served(false, async (url) => {
        const page = await openPage({ url });
        await assertWorkers(page, await most(page));
    });
}

export async function oneAndFive() {
    for (const count of [1, 5]) await assertWorkers(await openPage({ query: `?scene=coarse&workers=${count}` }), count);
}

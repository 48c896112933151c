// test_races.mjs - another mesh is wished for while something about the one before is on its way.
import assert from 'node:assert/strict';
import { answerAfter, answerOf, assertSame, settled } from './answer.mjs';
import { dropFile, openPage, usualPage } from './browser.mjs';
import { coarseFile, small, stlBytes } from './meshes.mjs';

/** Asks about the mesh once more just before Workers are handed the next; keeps what the page says of it in `said`. */
function askAtLoad() {
    const { postMessage } = Worker.prototype;
    window.said = [];
    for (const id of ['message', 'unlike-numbers']) {
        const element = document.getElementById(id);
        new MutationObserver(() => window.said.push(element.textContent)).observe(element, { childList: true });
    }
    Worker.prototype.postMessage = function (...all) {
        if (all[0].what === 'load') {
            Worker.prototype.postMessage = postMessage;
            document.getElementById('reset').click();
        }
        postMessage.apply(this, all);
    };
}

/** What is on its way is an answer about the mesh before, joined as that was dealt out. */
export async function questionBeforeLoad() {
    const page = await openPage({ query: '?scene=ties&workers=2' });
    await page.click('#accuracy [value=fast]');
    await page.waitForFunction(() => document.getElementById('unlike-numbers').textContent);
    const numbers = await page.textContent('#unlike-numbers');
    await page.evaluate(askAtLoad);
    assertSame(await answerAfter(page, () => page.selectOption('#scene', 'coarse')), coarseFile);
    const said = await page.evaluate(() => [...new Set(window.said)].filter(Boolean));
    assert.deepEqual(said, [numbers, await page.textContent('#unlike-numbers')].filter(Boolean));
}

export async function measureEndsAtLoad() {
    const page = await usualPage();
    await page.evaluate(() => {
        const scene = document.getElementById('scene');
        document.getElementById('measure').click();
        scene.value = 'ties';
        scene.dispatchEvent(new Event('change'));
    });
    await page.waitForSelector('#measure:enabled');
    assert.equal(await page.textContent('#chart'), 'Another mesh was shown meanwhile. Press Measure again.');
}

/** A file that takes long to read does not replace what was chosen after it. */
export async function latestMeshStays() {
    const page = await usualPage();
    await page.evaluate(() => {
        const { postMessage } = Worker.prototype;
        Worker.prototype.postMessage = function (...all) {
            if (all[0].what !== 'read') return postMessage.apply(this, all);
            Worker.prototype.postMessage = postMessage;
            window.readOn = () => postMessage.apply(this, all);
        };
    });
    await dropFile(page, 'slow.stl', stlBytes(small));
    await page.waitForFunction(() => window.readOn);
    assert.match(await page.textContent('#progress'), /^Reading slow\.stl: \d+ %$/);
    const chosen = await answerAfter(page, () => page.selectOption('#scene', 'ties'));
    await page.evaluate(() => window.readOn());
    await settled(page);
    await page.waitForTimeout(300);
    assert.equal((await answerOf(page)).command, chosen.command);
    assert.equal(await page.inputValue('#scene'), 'ties');
    assert.ok(await page.isHidden('#progress'));
}

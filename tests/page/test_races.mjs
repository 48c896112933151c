// test_races.mjs - another mesh is wished for while something about the one before is on its way.
import assert from 'node:assert/strict';
import { usualPage } from './browser.mjs';

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

// measure.mjs - prints what an answer about a million triangles takes in this browser, while the box moves and at rest.
import { openPage, closePages, close } from './browser.mjs';

for (const workers of [1, 2]) {
    const page = await openPage({ query: `?scene=million&workers=${workers}` });
    for (const accuracy of ['exact', 'conservative', 'fast']) {
        await page.click(`#accuracy [value=${accuracy}]`);
        await page.waitForTimeout(2500);
        console.log(`${workers} worker(s), ${accuracy}: ${await page.textContent('#time')}, ${await page.textContent('#rate')}`);
    }
    await page.click('#accuracy [value=exact]');
    await page.check('#by-index');
    await page.waitForTimeout(6000);
    console.log(`${workers} worker(s), exact: ${await page.textContent('#time')}, ${await page.textContent('#rate')}`);
    await page.uncheck('#by-index');
    await page.click('#measure');
    await page.waitForSelector('.bars', { timeout: 60000 });
    const chart = await page.$$eval('.bars dt, .bars dd', (all) => all.map((e) => e.textContent).join(' '));
    console.log(`${workers} worker(s), chart: ${chart}`);
    await closePages();
}
await close();

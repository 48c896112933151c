// measure.mjs - prints what an answer about a million triangles takes in this browser, and pictures that follow each other.
import { close, closePages, openPage } from './browser.mjs';

const PATIENCE = 120000; // pictures of a million triangles take seconds without a graphics card
const options = { viewport: { width: 360, height: 360 } };

/** Presses a button without waiting for a picture. */
const press = (page, selector) => page.evaluate((s) => document.querySelector(s).click(), selector);

/** The time that is shown once it has not changed for some seconds. */
async function timeShown(page) {
    let last = '';
    for (let same = 0; same < 4; await page.waitForTimeout(1000)) {
        const shown = await page.evaluate(
            () => `${document.getElementById('time').value}, ${document.getElementById('rate').textContent}`,
        );
        same = shown === last ? same + 1 : 0;
        last = shown;
    }
    return last;
}

for (const workers of [1, 2]) {
    const page = await openPage({ options, query: `?scene=million&workers=${workers}` });
    page.setDefaultTimeout(PATIENCE);
    for (const choice of ['#accuracy [value=fast]', '#accuracy [value=conservative]', '#accuracy [value=exact]', '#by-index']) {
        await press(page, choice);
        console.log(`${workers} worker(s), ${choice}: ${await timeShown(page)}`);
    }
    await press(page, '#by-index');
    await press(page, '#measure');
    await page.waitForSelector('.bars', { state: 'attached' });
    const chart = await page.$$eval('.bars dt, .bars dd', (all) => all.map((e) => e.textContent).join(' '));
    console.log(`${workers} worker(s), chart: ${chart}`);
    await closePages();
}
/** Milliseconds from picture to picture, for some seconds, sorted. */
const frames = (page) =>
    page.evaluate(
        () =>
            new Promise((done) => {
                const times = [];
                let before = performance.now();
                const end = before + 5000;
                const step = (now) => {
                    times.push(Math.round(now - before));
                    before = now;
                    if (now < end) requestAnimationFrame(step);
                    else done(times.slice(1).sort((a, b) => a - b));
                };
                requestAnimationFrame(step);
            }),
    );

for (const query of ['?', '?step=2', '?step=3', '?step=5', '?scene=paper', '?scene=knot', '?scene=million']) {
    const page = await openPage({ options: { viewport: { width: 1440, height: 900 } }, query });
    if (query.startsWith('?scene')) await press(page, '#play');
    await page.waitForTimeout(3000);
    const times = await frames(page);
    const ofNine = times[Math.floor(0.9 * times.length)];
    console.log(`${query}: ${times[times.length >> 1]} ms a picture, ${ofNine} at most of nine in ten`);
    await closePages();
}
await close();

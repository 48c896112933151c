// film.mjs - the pictures of a short film of the page, numbered: film.mjs FOLDER. examples/web/film.sh makes one of them.
import { mkdir } from 'node:fs/promises';
import { join } from 'node:path';
import { close, openPage } from './browser.mjs';

const [folder] = process.argv.slice(2);
const SHOWN = { viewport: { width: 960, height: 600 }, colorScheme: 'dark', reducedMotion: 'reduce' };
const RESTS = 900; // until a picture has all its pixels

/** Types a box whose centre is on a way through the knot; part: 0 to 1, where the way begins again. */
const moveBox = (part) => (page) =>
    page.evaluate((turn) => {
        const center = [1.2 + 1.1 * Math.sin(turn), 0.4 + 1.1 * Math.sin(2 * turn), 0.4 * Math.sin(turn)],
            numbers = document.getElementById('numbers');
        numbers.value = [...center.map((c) => c - 1), ...center.map((c) => c + 1)].map((x) => x.toFixed(4)).join();
        numbers.dispatchEvent(new Event('change'));
    }, 2 * Math.PI * part);

/** As a hand does, but without the focus. */
const setSlider = (page, x) =>
    page.$eval(
        '#slide',
        (slider, value) => {
            slider.value = value;
            slider.dispatchEvent(new Event('input'));
        },
        x,
    );

const slide = (part) => (page) => setSlider(page, 0.5 - 0.7 * Math.sin(2 * Math.PI * part));

const parts = [
    { query: '', count: 18, act: moveBox },
    { query: '?step=1', count: 12, act: slide },
    { query: '?step=5', count: 12, act: moveBox },
];

await mkdir(folder, { recursive: true });
let number = 0;
for (const { query, count, act } of parts) {
    const page = await openPage({ options: SHOWN, query });
    if (!query) await page.waitForFunction(() => document.getElementById('factor').textContent);
    await page.waitForTimeout(RESTS);
    for (let i = 0; i < count; i++) {
        await act(i / count)(page);
        await page.waitForTimeout(RESTS);
        await page.screenshot({ path: join(folder, `${String(number++).padStart(3, '0')}.png`) });
    }
    await page.context().close();
}
await close();

// pictures.mjs - pictures of the page, to be looked at, or numbered for a film (examples/web/film.sh):
//   pictures.mjs pictures|film FOLDER
import { mkdir } from 'node:fs/promises';
import { join } from 'node:path';
import { settled } from './answer.mjs';
import { close, closePages, DESK, openPage, PHONE } from './browser.mjs';

const [kind, folder = '.'] = process.argv.slice(2);
const LIGHT = { ...DESK, colorScheme: 'light' }, LIGHT_PHONE = { ...PHONE, colorScheme: 'light' };
const FILM = { viewport: { width: 960, height: 600 }, colorScheme: 'dark' };
const RESTS = 900; // until a picture has all its pixels

async function turn(page) {
    await page.click('#mode [value=rotate]');
    await page.focus('#canvas');
    for (const key of ['Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowUp'])
        await page.keyboard.press(key);
}

async function measure(page) {
    await page.click('#measure');
    await page.waitForSelector('.bars', { timeout: 30000 });
    await page.locator('#chart').scrollIntoViewIfNeeded();
}

/** Gives an element a value as a hand does, but without the focus. */
const set = (page, selector, value, event) =>
    page.$eval(selector, (to, [given, name]) => {
        to.value = given;
        to.dispatchEvent(new Event(name));
    }, [value, event]);

/** Types a box whose centre is on a way through the knot; part: 0 to 1, where the way begins again. */
function moveBox(page, part) {
    const at = 2 * Math.PI * part, center = [1.2 + 1.1 * Math.sin(at), 0.4 + 1.1 * Math.sin(2 * at), 0.4 * Math.sin(at)];
    const numbers = [...center.map((c) => c - 1), ...center.map((c) => c + 1)].map((x) => x.toFixed(4)).join();
    return set(page, '#numbers', numbers, 'change');
}

/** The axis of the figure in the plane goes round. */
async function turnAxis(page, part) {
    await page.focus('[aria-label=Axis]');
    for (let i = 0; part && i < 10; i++) await page.keyboard.press('ArrowUp');
}

/** Name, window, scene or step of the story, what is done, and how often, for as many pictures. */
const rows = {
    pictures: [
        ...[0, 1, 2, 3, 4, 5, 6, 7, 8].map((step) => [`step${step}`, DESK, `?step=${step}`]), ['dark', DESK, '?scene=knot'],
        ['light', LIGHT, '?scene=coarse'], ['phone', PHONE, '?scene=coarse'],
        ['phone-light', LIGHT_PHONE, '?scene=coarse', (page) => page.locator('#measure').scrollIntoViewIfNeeded()],
        ['cells', DESK, '?scene=coarse', (page) => page.fill('#resolution', '48')], ['turned', LIGHT, '?scene=coarse', turn],
        ['unlike', LIGHT, '?scene=ties', (page) => page.click('#accuracy [value=fast]')], ['chart', DESK, '?scene=knot', measure],
    ],
    film: [['', FILM, '', moveBox, 18], ['', FILM, '?step=1', turnAxis, 12], ['', FILM, '?step=8', moveBox, 12]],
};

await mkdir(folder, { recursive: true });
let number = 0;
for (const [name, options, query, act, count = 1] of rows[kind]) {
    const page = await openPage({ options: { ...options, reducedMotion: 'reduce' }, query }); // which would never settle
    if (!query) await page.waitForFunction(() => document.getElementById('factor').textContent);
    await page.waitForTimeout(RESTS);
    for (let i = 0; i < count; i++, number++) {
        await act?.(page, i / count);
        await settled(page);
        await page.waitForTimeout(RESTS);
        await page.screenshot({ path: join(folder, `${name || String(number).padStart(3, '0')}.png`) });
    }
    await closePages();
}
await close();

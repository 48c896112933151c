// pictures.mjs - pictures of the page, to be looked at: pictures.mjs FOLDER
import { mkdir } from 'node:fs/promises';
import { join } from 'node:path';
import { settled } from './answer.mjs';
import { close, closePages, DESK, openPage, PHONE } from './browser.mjs';

const [folder = '.'] = process.argv.slice(2);
const LIGHT = { ...DESK, colorScheme: 'light' }, LIGHT_PHONE = { ...PHONE, colorScheme: 'light' };
const SETTLED = 700;

/** Name, window, scene or step of the story, what is done. */
const pictures = [
    ...[0, 1, 2, 3, 4, 5].map((step) => [`step${step}.png`, DESK, step, async () => {}]),
    ['dark.png', DESK, 'knot', async () => {}],
    ['light.png', LIGHT, 'coarse', async () => {}],
    ['phone.png', PHONE, 'coarse', async () => {}],
    ['phone-light.png', LIGHT_PHONE, 'coarse', async (page) => page.locator('#measure').scrollIntoViewIfNeeded()],
    ['cells.png', DESK, 'coarse', async (page) => page.fill('#resolution', '48')],
    [
        'turned.png',
        LIGHT,
        'coarse',
        async (page) => {
            await page.click('#mode [value=rotate]');
            await page.focus('#canvas');
            for (const key of ['Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowUp'])
                await page.keyboard.press(key);
        },
    ],
    ['unlike.png', LIGHT, 'ties', async (page) => page.click('#accuracy [value=fast]')],
    [
        'chart.png',
        DESK,
        'knot',
        async (page) => {
            await page.click('#measure');
            await page.waitForSelector('.bars', { timeout: 30000 });
            await page.locator('#chart').scrollIntoViewIfNeeded();
        },
    ],
];

await mkdir(folder, { recursive: true });
for (const [name, options, scene, act] of pictures) {
    const page = await openPage({ options, query: `?${typeof scene === 'number' ? 'step' : 'scene'}=${scene}` });
    await act(page);
    await settled(page);
    await page.waitForTimeout(SETTLED);
    await page.screenshot({ path: join(folder, name) });
    console.log(join(folder, name));
    await closePages();
}
await close();

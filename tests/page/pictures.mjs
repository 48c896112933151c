// pictures.mjs - pictures of the page, to be looked at: pictures.mjs FOLDER
import { mkdir } from 'node:fs/promises';
import { join } from 'node:path';
import { settled } from './answer.mjs';
import { close, closePages, DESK, openPage, PHONE } from './browser.mjs';

const [folder = '.'] = process.argv.slice(2);
const LIGHT = { ...DESK, colorScheme: 'light' },
    LIGHT_PHONE = { ...PHONE, colorScheme: 'light' };
const SETTLED = 700;

const pictures = [
    ['dark', DESK, 'knot', async () => {}],
    ['light', LIGHT, 'coarse', async () => {}],
    ['phone', PHONE, 'coarse', async () => {}],
    ['phone-light', LIGHT_PHONE, 'coarse', async (page) => page.locator('#measure').scrollIntoViewIfNeeded()],
    ['cells', DESK, 'coarse', async (page) => page.fill('#resolution', '48')],
    [
        'turned',
        LIGHT,
        'coarse',
        async (page) => {
            await page.click('#mode [value=rotate]');
            await page.focus('#canvas');
            for (const key of ['Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowUp'])
                await page.keyboard.press(key);
        },
    ],
    ['unlike', LIGHT, 'ties', async (page) => page.click('#accuracy [value=fast]')],
    [
        'chart',
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
    const page = await openPage({ options, query: `?scene=${scene}` });
    await act(page);
    await settled(page);
    await page.waitForTimeout(SETTLED);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    console.log(`${join(folder, name)}.png`);
    await closePages();
}
await close();

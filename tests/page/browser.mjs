// browser.mjs - one chromium, and pages in it that fail a test when anything is written to the console as an error.
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { settled } from './answer.mjs';

const { chromium } = createRequire(join(process.env.PLAYWRIGHT, 'x'))('playwright-core');
const executablePath = execFileSync('sh', ['-c', `command -v ${process.env.CHROMIUM}`], { encoding: 'utf8' }).trim();
const TIMEOUT = 20000; // on a busy machine

export const DESK = { viewport: { width: 1280, height: 800 }, colorScheme: 'dark' };
export const SMALL = { viewport: { width: 900, height: 480 }, colorScheme: 'dark' }; // soon drawn without a graphics card
export const PHONE = {
    viewport: { width: 360, height: 740 },
    deviceScaleFactor: 2,
    isMobile: true,
    hasTouch: true,
    colorScheme: 'dark',
};
const fileUrl = pathToFileURL(process.env.PAGE).href;

let browser = null;
let usual = null; // the page that most tests take, one after another
let open = [];
const errors = [];

const hasAnswered = () => document.getElementById('command').textContent || !document.getElementById('message').hidden;

/** A page of its own that has answered about the mesh it begins with. prepare: run in it first. */
export async function openPage({ options = SMALL, query = '?scene=coarse', url = fileUrl, prepare } = {}) {
    browser ??= await chromium.launch({ executablePath, args: ['--no-sandbox'] });
    const context = await browser.newContext(options), page = await context.newPage();
    page.setDefaultTimeout(TIMEOUT);
    page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
    page.on('pageerror', (error) => errors.push(error.stack));
    open.push(context);
    if (prepare) await page.addInitScript(prepare);
    await page.goto(url + query);
    await page.waitForFunction(hasAnswered);
    return page;
}

/** The page that others have used, with all that can be chosen as it was. */
export async function usualPage() {
    if (!usual) {
        usual = await openPage();
        open = [];
        return usual;
    }
    await usual.click('#accuracy [value=exact]');
    await usual.click('#mode [value=translate]');
    for (const axis of [1, 2, 4]) await usual.check(`[name=axes][value="${axis}"]`);
    for (const box of ['#cells', '#by-index']) await usual.uncheck(box);
    await usual.selectOption('#order', '0');
    await usual.evaluate(() => (document.getElementById('command').textContent = ''));
    await usual.selectOption('#scene', 'coarse');
    await usual.waitForFunction(() => document.getElementById('command').textContent.includes('=0.2,-0.6,-1,2.2,1.4,1 '));
    await settled(usual); // the mesh before may answer once more
    return usual;
}

/** Drops a file on the page, as a hand does. */
export async function dropFile(page, name, content) {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    await page.evaluate(
        ([file, base64]) => {
            const data = new DataTransfer(), text = atob(base64);
            data.items.add(new File([Uint8Array.from(text, (letter) => letter.charCodeAt(0))], file));
            for (const type of ['dragenter', 'dragover', 'drop'])
                document
                    .querySelector('canvas')
                    .dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
        },
        [name, Buffer.from(bytes).toString('base64')],
    );
}

/** Closes what a test has opened; throws if any page complained. */
export async function closePages() {
    const closing = open, said = errors.splice(0);
    open = [];
    for (const context of closing) await context.close();
    if (said.length) throw new Error(`errors on the console:\n${said.join('\n')}`);
}

/** After a failure the next test begins anew. */
export async function forgetPages() {
    open.push(...(usual ? [usual.context()] : []));
    usual = null;
    await closePages().catch(() => {});
}

export async function close() {
    await browser?.close();
}

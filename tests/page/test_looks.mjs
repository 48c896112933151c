// test_looks.mjs - dark and light, a phone, names for those who cannot see, and pixels of every class.
import assert from 'node:assert/strict';
import { settled, soon } from './answer.mjs';
import { DESK, openPage, PHONE, usualPage } from './browser.mjs';

const themeOf = (page) => page.evaluate(() => document.documentElement.dataset.theme);

/** How many pixels of the stage, or of a part, are near a colour of the style sheet, whatever the light. */
async function pixelsLike(page, name, clip) {
    const picture = (await (clip ? page.screenshot({ clip }) : page.locator('canvas').screenshot())).toString('base64');
    return page.evaluate(
        async ([base64, variable]) => {
            const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
            const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
            context.drawImage(image, 0, 0);
            const { data } = context.getImageData(0, 0, image.width, image.height);
            const text = getComputedStyle(document.documentElement).getPropertyValue(`--${variable}`).trim();
            const wanted = [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)), length = Math.hypot(...wanted);
            let count = 0;
            for (let i = 0; i < data.length; i += 4) {
                const size = Math.hypot(data[i], data[i + 1], data[i + 2]);
                const cosine = (data[i] * wanted[0] + data[i + 1] * wanted[1] + data[i + 2] * wanted[2]) / (size * length);
                if (cosine > 0.99 && size > 0.4 * length) count++;
            }
            return count;
        },
        [picture, name],
    );
}

export async function classesAreDrawn() {
    const page = await usualPage();
    await settled(page);
    for (const name of ['straddling', 'inside']) assert.ok((await pixelsLike(page, name)) > 500, name);
    const before = await pixelsLike(page, 'cells'); // the green handle
    await page.check('#cells');
    await page.waitForFunction(() => document.getElementById('cells-note').textContent.includes(' of '));
    await soon(async () => assert.ok((await pixelsLike(page, 'cells')) > before + 10000, 'cells'));
}

export async function ringsAreDrawn() {
    const page = await openPage({ query: '?scene=ties' });
    assert.ok((await pixelsLike(page, 'unlike')) < 50);
    await page.click('#accuracy [value=fast]');
    await page.waitForFunction(() => document.getElementById('unlike-title').textContent.startsWith('FAST'));
    await soon(async () => assert.ok((await pixelsLike(page, 'unlike')) > 2000));
}

/** What is drawn in place of a million triangles covers what a few thousand of the same shape do, and little else. */
export async function coarserMeshesAreWhole() {
    const open = (scene) => openPage({ query: `?scene=${scene}`, options: { ...DESK, reducedMotion: 'reduce' } });
    const pages = [await open('coarse'), await open('million')];
    await soon(async () => {
        const [coarse, million] = [await pixelsLike(pages[0], 'missed'), await pixelsLike(pages[1], 'missed')];
        assert.ok(Math.abs(million / coarse - 1) < 0.1, `${million} and ${coarse} pixels`);
    });
}

/** The mesh is above the counts, on a desk and on a phone. */
export async function countsCoverNothing() {
    for (const viewport of [{ width: 390, height: 844 }, { width: 800, height: 1000 }, { width: 1400, height: 900 }]) {
        const page = await openPage({ query: '?step=0', options: { viewport, reducedMotion: 'reduce', colorScheme: 'dark' } });
        const clip = await page.locator('.answer').boundingBox();
        await page.addStyleTag({ content: '.answer { visibility: hidden }' });
        for (const name of ['missed', 'straddling', 'inside']) {
            await soon(async () => assert.ok((await pixelsLike(page, name)) > 100, name));
            assert.equal(await pixelsLike(page, name, clip), 0, `${viewport.width}: ${name}`);
        }
        await page.context().close();
    }
}

/** WCAG's contrast of two colours of the style sheet. */
const contrasts = (pairs) => {
    const style = getComputedStyle(document.documentElement);
    const light = (name) => {
        const text = style.getPropertyValue(`--${name}`).trim();
        const [r, g, b] = [1, 3, 5]
            .map((at) => parseInt(text.slice(at, at + 2), 16) / 255)
            .map((c) => (c > 0.04045 ? ((c + 0.055) / 1.055) ** 2.4 : c / 12.92));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    return pairs.map(([a, b]) => {
        const [high, low] = [light(a), light(b)].sort((x, y) => y - x);
        return (high + 0.05) / (low + 0.05);
    });
};

export async function darkAndLight() {
    for (const colorScheme of ['dark', 'light']) {
        const page = await openPage({ options: { ...DESK, colorScheme } });
        assert.equal(await themeOf(page), colorScheme);
        await page.click('#theme');
        assert.notEqual(await themeOf(page), colorScheme);
        const texts = [
            ['text', 'panel'], ['soft', 'panel'], ['soft', 'raised'], ['text', 'ground'], ['soft', 'ground'], ['soft', 'glow'],
            ['on-accent', 'accent'], ['alert', 'alert-ground'],
        ];
        const read = await page.evaluate(contrasts, texts);
        read.forEach((ratio, i) => assert.ok(ratio >= 4.5, `${texts[i]}: ${ratio.toFixed(2)}`));
        const shapes = [['accent', 'panel'], ['box', 'ground']], seen = await page.evaluate(contrasts, shapes);
        seen.forEach((ratio, i) => assert.ok(ratio >= 3, `${shapes[i]}: ${ratio.toFixed(2)}`));
    }
}

/** Nothing is wider than a phone, with the controls and beside a picture of the story; and what is pressed is large enough. */
export async function phone() {
    for (const query of ['?scene=coarse', '?step=1']) {
        const page = await openPage({ query, options: { ...PHONE, reducedMotion: 'reduce' } });
        const { width, wide, low } = await page.evaluate(() => {
            const all = [...document.querySelectorAll('body *')].filter(
                (e) => e.checkVisibility() && !e.closest('svg, .visually-hidden'),
            );
            return {
                width: document.documentElement.scrollWidth,
                wide: all
                    .filter((e) => e.getBoundingClientRect().right > innerWidth + 0.5).map((e) => e.id || e.className || e.tagName),
                low: all
                    .filter((e) => e.matches('.panel :is(button, select, input[type=text])'))
                    .filter((e) => e.getBoundingClientRect().height < 36).map((e) => e.id || e.value),
            };
        });
        assert.deepEqual([width, wide, low], [360, [], []], query);
    }
}

export async function namesAndFocus() {
    const page = await openPage();
    const nameless = await page.$$eval('button, select, input, canvas', (all) =>
        all
            .filter((e) => !e.hidden && !(e.ariaLabel || e.textContent.trim() || e.labels?.[0]?.textContent.trim()))
            .map((e) => e.outerHTML),
    );
    assert.deepEqual(nameless, []);
    const seen = [];
    for (let i = 0; i < 40; i++) {
        await page.keyboard.press('Tab');
        const at = await page.evaluate(() => {
            const focused = document.activeElement, style = getComputedStyle(focused);
            return {
                name: focused.id || focused.value || focused.tagName,
                outline: style.outlineStyle === 'none' ? 0 : parseFloat(style.outlineWidth),
            };
        });
        if (at.name === 'BODY') break;
        assert.ok(at.outline >= 2, `${at.name} has no outline where it has the focus`);
        seen.push(at.name);
    }
    for (const name of [
        'canvas', 'play', 'reset', 'theme', 'scene', 'open', 'order', 'by-index', 'cells', 'resolution', 'measure', 'numbers',
    ])
        assert.ok(seen.includes(name), `${name} is not reached by Tab: ${seen}`);
}

export async function choicesByArrows() {
    const page = await usualPage();
    await page.focus('#accuracy [aria-checked=true]');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.evaluate(() => document.activeElement.value), 'conservative');
    assert.equal(await page.getAttribute('#accuracy [value=conservative]', 'aria-checked'), 'true');
}

export async function reducedMotion() {
    const page = await openPage({ options: { ...DESK, reducedMotion: 'reduce' } });
    assert.equal(await page.$eval('#play', (button) => getComputedStyle(button).transitionDuration), '0s');
    assert.equal(await page.getAttribute('#play', 'aria-pressed'), 'false');
}

/** Neither a word of the command nor a number is broken, whatever the width, unless it is longer than a line. */
export async function commandsBreakAtWords() {
    const page = await usualPage();
    const pieces = await page.evaluate(async () => {
        const code = document.getElementById('command'), seen = [];
        for (let width = 60; width < 360; width += 7) {
            code.parentElement.style.width = `${width}px`;
            for (const span of code.querySelectorAll('span')) seen.push([span.textContent, span.offsetHeight, width]);
        }
        code.parentElement.style.width = '';
        return seen;
    });
    assert.deepEqual(pieces.slice(0, 2).map(([text]) => text), ['tribox ', 'tribox ']);
    assert.deepEqual(pieces.filter(([text, height, width]) => height > 30 && 8 * text.length < width), []);
}

export async function countsAreSpoken() {
    const page = await usualPage();
    await page.waitForFunction(() => document.getElementById('spoken').textContent.includes('straddle the box'));
}

/** The time changes at every move; an output is read aloud by itself. */
export async function timeIsNotSpoken() {
    assert.equal(await (await usualPage()).getAttribute('#time', 'aria-live'), 'off');
}

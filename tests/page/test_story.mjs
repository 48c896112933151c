// test_story.mjs - the pictures one scrolls through: the opening, thirteen axes, an index, ties, cells; and no picture at all.
import assert from 'node:assert/strict';
import { axesOf, steps } from '../../examples/web/src/story.js';
import { visitsOf } from '../../examples/web/src/visits.js';
import { answerOf, ask, settled } from './answer.mjs';
import { DESK, openPage, PHONE, SMALL } from './browser.mjs';
import { raw } from './meshes.mjs';

const STILL = { ...SMALL, reducedMotion: 'reduce' };

/** Multiples of 1/8 near the cube from -1 to 1, where touching is as likely as not. */
function gridTriangles(count) {
    let seed = 11;
    return Float32Array.from({ length: 9 * count }, () => {
        seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
        return ((seed >>> 16) % 33) / 8 - 2;
    });
}

/** A gap is shown on some axis of a group where the program, asked with that group alone, says that the triangle misses. */
export function gapsAreTheLibrarys() {
    const count = 5000, triangles = gridTriangles(count), file = raw('grid.f32', triangles);
    const axes = Array.from({ length: count }, (_, i) => axesOf(triangles.subarray(9 * i, 9 * i + 9)));
    assert.equal(axes[0].length, 13);
    for (const group of ['box', 'plane', 'edges']) {
        const { indices } = ask(['overlap', 'MESH', '--box=-1,-1,-1,1,1,1', '--axes', group, '--list'], file),
            hits = new Set(indices);
        const apart = axes.map((all) => all.some((axis) => axis.group === group && axis.gap > 0));
        assert.deepEqual(apart.map((isApart, i) => isApart === !hits.has(i)), Array(count).fill(true), group);
        assert.ok(hits.size > 500 && hits.size < count, `${group}: ${hits.size}`);
    }
}

export async function opens() {
    const page = await openPage({ query: '', options: DESK });
    assert.ok(await page.isVisible('#steps'));
    assert.ok(await page.isHidden('.panel'));
    assert.match(await page.textContent('.steps .lead'), /^tribox is a C library that tells which of millions of triangles/);
    const first = await answerOf(page);
    await page.waitForFunction(() => /^[\d.]+ × the paper’s$/.test(document.getElementById('factor').textContent));
    await page.waitForFunction((old) => document.getElementById('command').textContent !== old, first.command);
    assert.equal(first.straddling + first.inside + first.missed, 8000);
    await page.mouse.move(400, 400);
    await page.keyboard.press('Tab');
    await page.focus('#canvas');
    await page.keyboard.press('ArrowUp');
    assert.equal(await page.textContent('#play'), 'Play', 'the box moves on though it was touched');
    const links = await page.$$eval('.links a', (all) => all.map((a) => [a.textContent, a.getAttribute('href')]));
    assert.deepEqual(links.map(([name]) => name), ['Source', 'Documents']);
    assert.ok(links.every(([, address]) => address && !address.startsWith('built:')), `${links}`);
}

export async function cornersMove() {
    const page = await openPage({ query: '?step=1', options: STILL });
    await page.waitForSelector('#axes li');
    await page.focus('#canvas');
    const seen = new Set();
    for (const keys of ['2', 'PageDown PageDown PageDown PageDown', '1 ArrowDown ArrowDown ArrowDown', '3 ArrowUp', 'ArrowLeft']) {
        for (let again = 0; again < 4; again++) {
            for (const key of keys.split(' ')) await page.keyboard.press(key);
            await page.waitForTimeout(250);
            const { missed, straddling } = await answerOf(page), lit = await page.$$eval('#axes .is-apart', (all) => all.length);
            assert.equal(missed + straddling, 1);
            assert.equal(lit > 0, missed === 1, `${lit} axes are lit`);
            assert.match(
                await page.textContent('#verdict'),
                missed ? new RegExp(lit === 1 ? 'one axis shows' : `${lit} axes show`) : /no axis/,
            );
            seen.add(missed);
        }
    }
    assert.equal(seen.size, 2, 'the triangle was always apart, or never');
    await page.fill('#slide', '2');
    await page.waitForFunction(() => document.querySelectorAll('#axes .is-apart').length > 0);
}

export async function indexIsLookedAt() {
    const page = await openPage({ query: '?step=3', options: STILL });
    await page.waitForFunction(() => document.getElementById('visits').textContent, undefined, { timeout: 40000 });
    const [looked, ofNodes, tested, ofWords] = (await page.textContent('#visits'))
        .match(/^([\d,]+) of ([\d,]+) nodes looked at, ([\d,]+) of ([\d,]+) groups/)
        .slice(1).map((n) => Number(n.replaceAll(',', '')));
    const { rate, straddling, inside, missed } = await answerOf(page);
    assert.match(rate, /^by the index/);
    assert.equal(straddling + inside + missed, 1000000);
    assert.ok(looked < ofNodes / 4 && tested < ofWords / 10 && ofWords === 15625, `${looked} ${ofNodes} ${tested} ${ofWords}`);
    assert.ok(straddling <= 64 * tested);
}

/** Two levels made by hand: the second child of the root is beside the box, the first one's children are beside, in and across. */
export function visitsAreCounted() {
    const floats = new Float32Array(400 * 3).fill(Infinity),
        put = (node, child, box) => box.forEach((x, row) => (floats[400 * node + 64 * row + child] = x));
    put(0, 0, [5, 5, 5, 6, 6, 6]);
    put(0, 1, [0.5, 0.5, 0.5, 1, 1, 1]);
    put(0, 2, [1, 1, 1, 3, 3, 3]);
    put(1, 0, [9, 9, 9, 10, 10, 10]);
    put(2, 0, [0, 0, 0, 6, 6, 6]);
    put(2, 1, [9, 9, 9, 10, 10, 10]);
    const { nodes, words, ofNodes, ofWords } = visitsOf(floats, 64 * 65, { lo: [0, 0, 0], hi: [2, 2, 2] });
    assert.deepEqual([...nodes], [0, 0, 0, 6, 6, 6]);
    assert.deepEqual([...words], [1, 1, 1, 3, 3, 3]);
    assert.deepEqual([ofNodes, ofWords], [3, 65]);
}

export async function tiesDiffer() {
    const page = await openPage({ query: '?step=4', options: STILL });
    await page.waitForFunction(() => document.getElementById('ties-count').textContent.includes('wrong'));
    const wrong = Number((await page.textContent('#ties-count')).match(/^(\d+) of 30/)[1]);
    assert.ok(wrong >= 5 && wrong < 30, `${wrong} of 30`);
    await page.check('[name=rounding][value=exact]');
    await page.waitForFunction(() => document.getElementById('ties-count').textContent === 'All 30 are right.');
}

export async function cellsAndBox() {
    const page = await openPage({ query: '?step=5', options: STILL });
    for (const cells of ['32', '20']) {
        await page.fill('#cells-slider', cells);
        await page.waitForFunction((n) => document.getElementById('cells-note').textContent.includes(`${n} ×`), cells);
    }
}

export async function oneScrollsOrClicks() {
    const page = await openPage({ query: '', options: STILL });
    const current = () => page.$eval('#dots [aria-current=step]', (dot) => dot.ariaLabel);
    for (let i = 1; i < steps.length; i++) await page.click('#next');
    assert.match(await current(), /^5/);
    assert.ok(await page.isDisabled('#next'));
    await page.click('#dots li:nth-child(2) button');
    assert.match(await current(), /^1/);
    await page.$eval('#steps', (scroller) => scroller.scrollTo({ top: scroller.children[4].offsetTop, behavior: 'instant' }));
    await page.waitForFunction(() => /^4/.test(document.querySelector('#dots [aria-current=step]').ariaLabel));
    await page.waitForFunction(() => document.getElementById('ties-count').textContent);
    await page.click('#console');
    assert.ok(await page.isVisible('.panel'));
    assert.equal(await page.inputValue('#scene'), 'grazing');
    assert.equal(await page.getAttribute('#accuracy [value=fast]', 'aria-checked'), 'true');
    await page.click('#console');
    assert.match(await current(), /^4/);
}

/** Nothing is wider than a phone, in any picture. */
export async function phone() {
    const page = await openPage({ query: '?step=1', options: { ...PHONE, reducedMotion: 'reduce' } });
    const wide = await page.$$eval('.story *, .stage *', (all) =>
        all
            .filter((e) => e.checkVisibility() && !e.closest('svg, .visually-hidden, #axes'))
            .filter((e) => e.getBoundingClientRect().right > 360.5).map((e) => e.id || e.className || e.tagName),
    );
    assert.deepEqual(wide, []);
}

/** Without WebGL the answers are the same, in numbers. */
export async function withoutWebgl() {
    const page = await openPage({
        query: '?scene=coarse',
        prepare: () => {
            HTMLCanvasElement.prototype.getContext = OffscreenCanvas.prototype.getContext = () => null;
        },
    });
    assert.ok(await page.isVisible('.blind'));
    await settled(page);
    const { straddling, inside } = await answerOf(page);
    assert.ok(straddling > 0 && inside > 0);
    await page.focus('#canvas');
    await page.keyboard.press('ArrowUp');
    await page.waitForFunction((old) => document.getElementById('straddling').textContent !== old, `${straddling}`);
}

/** What is drawn without a graphics card: of the paper's triangles, each of which covers a part of the picture, hundreds. */
export async function budgetIsKept() {
    for (const [scene, most] of [['paper', 100], ['million', 16000]]) {
        const page = await openPage({ query: `?scene=${scene}`, options: SMALL });
        const [, drawn] = (await page.textContent('#mesh-note')).match(/Drawn: ([\d,]+) in place of all/);
        assert.ok(Number(drawn.replaceAll(',', '')) <= most / 2, `${scene}: ${drawn}`);
        await page.context().close();
    }
}

// test_story.mjs - the pictures one scrolls through: the opening, thirteen axes, an index, ties, cells; and no picture at all.
import assert from 'node:assert/strict';
import { axesOf } from '../../examples/web/src/axes.js';
import { scenes } from '../../examples/web/src/scenes/scenes.js';
import { steps } from '../../examples/web/src/story.js';
import { visitsOf } from '../../examples/web/src/visits.js';
import { answerAfter, answerOf, ask, settled, soon } from './answer.mjs';
import { DESK, openPage, SMALL } from './browser.mjs';
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
    assert.match(await page.textContent('.steps .lead'), /^tribox is a C library that finds which of millions of triangles/);
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

/** Grey beside the answer about another box, and as it was beside that about its own. */
export async function theFactorIsOfItsBox() {
    const page = await openPage({ query: '', options: STILL }), factor = page.locator('#factor:not(:empty)');
    const look = async () => [await factor.getAttribute('class'), await factor.getAttribute('title')];
    const own = ['', 'Both on one thread, timed for this box'];
    await factor.waitFor();
    assert.deepEqual(await look(), own);
    await page.focus('#canvas');
    await answerAfter(page, () => page.keyboard.press('ArrowUp'));
    assert.deepEqual(await look(), ['is-of-another', 'Both on one thread, timed for another box']);
    await answerAfter(page, () => page.click('#reset'));
    assert.deepEqual(await look(), own);
}

/** Of a triangle and the cube, by the program; axes: groups. */
const overlaps = (triangle, axes) => {
    const words = ['overlap', 'MESH', '--box=-1,-1,-1,1,1,1', ...(axes ? ['--axes', axes] : [])];
    return ask(words, raw('figure.f32', Float32Array.from(triangle))).overlapping === 1;
};

const figureOf = (page) =>
    page.evaluate(() => {
        const article = document.querySelectorAll('#steps article')[new URLSearchParams(location.search).get('step')];
        const names = [...document.querySelectorAll('.knob[aria-label^=Corner]')].map((knob) => knob.getAttribute('aria-label'));
        return {
            triangle: names.flatMap((name) => name.split(' at ')[1].split(',').map(Number)),
            verdict: article.querySelector('.verdict').textContent,
            lit: article.querySelectorAll('.axes .is-apart').length,
            shown: article.querySelector('.axes .is-shown')?.getAttribute('aria-label'),
            isApart: document.getElementById('figure').classList.contains('is-apart'),
        };
    });

async function dragBy(page, selector, x, y) {
    const box = await page.locator(selector).boundingBox(), from = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + x, from[1] + y, { steps: 3 });
    await page.mouse.up();
}

/** By hand and by keys, in the plane and in space, what is said is what the program says; a gap is shown only if they are apart. */
export async function figuresAnswer() {
    const places = [[-60, 10], [-40, 60], [60, -50], [20, 30]], seen = new Set();
    for (const step of [1, 2, 4]) {
        const page = await openPage({ query: `?step=${step}`, options: STILL }), before = await figureOf(page);
        for (const [i, [x, y]] of places.entries()) {
            await dragBy(page, i % 2 ? '.knob[aria-label^="Corner 1"] .grip' : '.body', x, y);
            await page.focus('.knob[aria-label^="Corner 2"]');
            for (const key of ['ArrowDown', 'PageUp', 'ArrowLeft']) await page.keyboard.press(key);
            await soon(async () => {
                const { triangle, verdict, lit, isApart } = await figureOf(page), text = `${step}: ${triangle}`;
                const hits = overlaps(triangle);
                assert.equal(verdict.startsWith('They overlap'), hits, text);
                if (hits) assert.ok(!isApart && lit === 0, text);
                if (step === 4) assert.equal(lit, axesOf(triangle).filter(({ gap }) => gap > 0).length, text);
                if (step === 1) assert.ok([2, 5, 8].every((z) => triangle[z] === 0), text);
                seen.add(`${step} ${hits}`);
            });
        }
        await page.click('#reset');
        assert.deepEqual((await figureOf(page)).triangle, before.triangle);
    }
    assert.ok(seen.size >= 5, `${[...seen]}`);
}

export async function theAxisTurns() {
    const page = await openPage({ query: '?step=1', options: STILL });
    await page.waitForFunction(() => document.querySelector('.verdict').textContent.startsWith('No gap'));
    assert.equal(overlaps((await figureOf(page)).triangle), false);
    await page.focus('[aria-label=Axis]');
    for (let i = 0; i < 15; i++) await page.keyboard.press('ArrowUp'); // 45 degrees
    assert.match((await figureOf(page)).verdict, /^A gap/);
    await soon(async () => assert.equal((await figureOf(page)).isApart, true));
    await dragBy(page, '[aria-label=Axis] .grip', -200, -200);
    assert.match((await figureOf(page)).verdict, /^No gap/);
}

/** What two figures begin with: apart by the triangle's normal alone, and by one axis of edges alone, which is the one shown. */
export async function oneAxisAloneParts() {
    for (const [step, others, name] of [[2, 'box,edges', 'n'], [3, 'box,plane', 'a12']]) {
        const page = await openPage({ query: `?step=${step}`, options: STILL });
        const { triangle, verdict, lit, shown } = await figureOf(page);
        assert.deepEqual([overlaps(triangle, others), overlaps(triangle)], [true, false]);
        assert.deepEqual(axesOf(triangle).filter(({ gap }) => gap > 0).map(({ letter, number }) => letter + number), [name]);
        assert.deepEqual([lit, shown], [1, `Axis ${name}: a gap`]);
        assert.match(verdict, /alone shows a gap/);
        await page.click(`article:nth-child(${step + 1}) .axes li:first-child button`);
        assert.match((await figureOf(page)).shown, /no gap/);
        await soon(async () => assert.equal((await figureOf(page)).isApart, false));
    }
}

/** A lane is lit where the program, asked with one group of axes more, first lets go of its triangle. */
export async function lanesLightUp() {
    const page = await openPage({ query: '?step=5', options: STILL }), file = raw('eight.f32', scenes.eight.make());
    await page.waitForSelector('.lanes .apart');
    await answerAfter(page, () => dragBy(page, '.lane-number >> nth=2', -30, 8)); // what is in front of the box lets it be held
    for (const keys of [[], Array(12).fill('ArrowRight'), Array(40).fill('PageDown')]) {
        await page.focus('#canvas');
        for (const key of keys) await page.keyboard.press(key);
        await settled(page);
        await soon(async () => {
            const [box] = (await answerOf(page)).command.match(/--box=\S+/), rows = await page.$$eval('.lanes tr', (all) =>
                all.map((row) => [...row.querySelectorAll('td')].map((cell) => cell.className)),
            );
            let before = [0, 1, 2, 3, 4, 5, 6, 7];
            for (const [t, axes] of ['box', 'box,plane', 'box,plane,edges'].entries()) {
                const left = ask(['overlap', 'MESH', box, '--axes', axes, '--list'], file).indices;
                const open = t === 2 ? 'overlaps' : 'open';
                const wanted = rows[t].map((_, i) => (left.includes(i) ? open : before.includes(i) ? 'apart' : 'done'));
                assert.deepEqual(rows[t], wanted, `${box} ${axes}`);
                before = left;
            }
        });
    }
}

/** No numbers about a single triangle; those beside the cells are theirs. */
export async function numbersAreOfThePicture() {
    const page = await openPage({ query: '?step=4', options: STILL });
    assert.ok(await page.isHidden('.answer'));
    await page.click('#dots li:nth-child(9) button');
    await page.waitForFunction(() => /^[\d,]+ of \d+ × \d+ × \d+ cells, /.test(document.getElementById('rate').textContent));
    await page.focus('#canvas');
    await answerAfter(page, () => page.keyboard.press('ArrowUp')); // which is about the box
    assert.match(await page.textContent('#rate'), / cells, /);
    assert.match(await page.textContent('#time'), /^(?!0\.000)[\d.]+ (µs|ms)$/);
    assert.ok(await page.isHidden('.classes'));
    await page.click('#dots li:nth-child(1) button');
    await page.waitForFunction(() => / ns a triangle, /.test(document.getElementById('rate').textContent));
}

export async function indexIsLookedAt() {
    const page = await openPage({ query: '', options: STILL });
    await page.click('#dots li:nth-child(7) button');
    await page.waitForSelector('article.is-waiting');
    await page.fill('#size-6', '0.35'); // meanwhile
    await page.waitForFunction(() => document.getElementById('visits').textContent, undefined, { timeout: 40000 });
    await settled(page);
    assert.equal(await page.locator('.is-waiting').count(), 0);
    assert.equal(await page.inputValue('#size-6'), '0.35');
    const [lo, , , hi] = (await answerOf(page)).command.match(/--box=(\S+)/)[1].split(',').map(Number);
    assert.ok(Math.abs(hi - lo - 0.7) < 1e-6, `${lo} to ${hi}`);
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
    const page = await openPage({ query: '?step=7', options: STILL });
    await page.waitForFunction(() => document.getElementById('ties-count').textContent.includes('wrong'));
    const wrong = Number((await page.textContent('#ties-count')).match(/^(\d+) of 30/)[1]);
    assert.ok(wrong >= 5 && wrong < 30, `${wrong} of 30`);
    await page.check('[name=rounding][value=exact]');
    await page.waitForFunction(() => document.getElementById('ties-count').textContent === 'All 30 are right.');
}

export async function cellsAndBox() {
    const page = await openPage({ query: '?step=8', options: STILL });
    for (const cells of ['32', '20']) {
        await page.fill('#cells-slider', cells);
        await page.waitForFunction((n) => document.getElementById('cells-note').textContent.includes(`${n} ×`), cells);
        assert.equal(await page.textContent('#cells-value'), cells);
    }
    for (const i of [1, 9]) await page.click(`#dots li:nth-child(${i}) button`); // which shows it as it was first
    assert.deepEqual([await page.inputValue('#cells-slider'), await page.textContent('#cells-value')], ['32', '32']);
}

export async function oneScrollsOrClicks() {
    const page = await openPage({ query: '', options: STILL });
    const current = () => page.$eval('#dots [aria-current=step]', (dot) => dot.ariaLabel);
    for (let i = 1; i < steps.length; i++) await page.click('#next');
    assert.match(await current(), /^8/);
    assert.ok(await page.isDisabled('#next'));
    await page.click('#dots li:nth-child(2) button');
    assert.match(await current(), /^1/);
    await page.$eval('#steps', (scroller) => scroller.scrollTo({ top: scroller.children[7].offsetTop, behavior: 'instant' }));
    await page.waitForFunction(() => /^7/.test(document.querySelector('#dots [aria-current=step]').ariaLabel));
    await page.waitForFunction(() => document.getElementById('ties-count').textContent);
    await page.click('#console');
    assert.ok(await page.isVisible('.panel'));
    assert.equal(await page.inputValue('#scene'), 'grazing');
    assert.equal(await page.getAttribute('#accuracy [value=fast]', 'aria-checked'), 'true');
    await page.click('#console');
    assert.match(await current(), /^7/);
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
    await page.click('#console'); // figures are drawn all the same
    await page.click('#dots li:nth-child(3) button');
    await page.waitForFunction(() => document.querySelectorAll('.verdict')[1].textContent.includes('alone'));
    for (const drawn of ['.solid.of-box', '.body', '.parting']) assert.ok(await page.isVisible(drawn), drawn);
    assert.ok(await page.isHidden('.blind'));
    await page.click('#console');
    await page.selectOption('#scene', 'coarse');
    await page.waitForFunction(() => document.getElementById('command').textContent.includes('=0.2,'));
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
        const [, drawn] = (await page.textContent('#mesh-note')).match(/Drawn coarser: ([\d,]+) triangles stand for [\d,]+\./);
        assert.ok(Number(drawn.replaceAll(',', '')) <= most / 2, `${scene}: ${drawn}`);
        await page.context().close();
    }
}

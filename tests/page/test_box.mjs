// test_box.mjs - the box is moved, turned and sized by pointer, touch, keyboard and numbers, and every answer is the program's.
import assert from 'node:assert/strict';
import { answerAfter, answerOf, assertSame, settled } from './answer.mjs';
import { openPage, PHONE, usualPage } from './browser.mjs';
import { coarse, coarseFile } from './meshes.mjs';

// Of the first view: on a face of the box, away from its handles, and on the ground.
const ON_BOX = [268, 199], ON_GROUND = [40, 200], ON_RING = [309, 165], ON_BOX_OF_PHONE = [182, 238];

const boxOf = ({ command }) => command.match(/=([-\d.e,]+)/)[1].split(',').map(Number);

async function drag(page, from, to) {
    await page.mouse.move(...from);
    await page.mouse.down();
    for (let step = 1; step <= 8; step++) await page.mouse.move(...from.map((f, a) => f + ((to[a] - f) * step) / 8));
    await page.mouse.up();
}

export async function begins() {
    const answer = await answerOf(await usualPage());
    assert.equal(answer.command, 'tribox overlap MESH --box=0.2,-0.6,-1,2.2,1.4,1 --inside');
    assertSame(answer, coarseFile);
    assert.ok(answer.straddling > 0 && answer.inside > 0);
}

export async function isDragged() {
    const page = await usualPage();
    let from = ON_BOX;
    for (const to of [[213, 144], [283, 174]]) {
        const before = boxOf(await answerOf(page)), answer = await answerAfter(page, () => drag(page, from, to));
        const after = boxOf(answer), sides = [0, 1, 2].map((a) => after[a + 3] - after[a] - (before[a + 3] - before[a]));
        assert.ok(sides.every((change) => Math.abs(change) < 1e-5), `sides change by ${sides}`);
        assertSame(answer, coarseFile);
        from = to;
    }
}

export async function groundTurnsTheView() {
    const page = await usualPage(), before = await page.locator('canvas').screenshot(), { command } = await answerOf(page);
    await drag(page, ON_GROUND, [140, 180]);
    await settled(page);
    assert.equal((await answerOf(page)).command, command);
    assert.ok(!before.equals(await page.locator('canvas').screenshot()), 'the picture is the same');
}

export async function isDraggedByFinger() {
    const page = await openPage({ options: PHONE }), devices = await page.context().newCDPSession(page);
    const touch = (type, x, y) =>
        devices.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x, y }] });
    const answer = await answerAfter(page, async () => {
        const [x, y] = ON_BOX_OF_PHONE;
        await touch('touchStart', x, y);
        for (let step = 1; step <= 6; step++) await touch('touchMove', x - 6 * step, y - 3 * step);
        await touch('touchEnd');
    });
    assertSame(answer, coarseFile);
    assert.equal(await page.evaluate(() => scrollY), 0);
}

export async function followsTheKeyboard() {
    const page = await usualPage();
    await page.focus('#canvas');
    const seen = new Set();
    for (const keys of [
        ['ArrowRight', 'ArrowRight'], ['ArrowUp'], ['PageDown', 'PageDown', 'PageDown'], ['+'], ['-', '-', '-'], ['Alt+ArrowLeft'],
    ]) {
        const answer = await answerAfter(page, async () => {
            for (const key of keys) await page.keyboard.press(key);
        });
        assertSame(answer, coarseFile);
        seen.add(boxOf(answer).join());
    }
    assert.equal(seen.size, 6);
}

/** No vertex is within rounding of the border, so doubles tell insides. */
function insidesOf(numbers) {
    const [center, half, ...axes] = [0, 3, 6, 9, 12].map((at) => numbers.slice(at, at + 3));
    let count = 0;
    for (let i = 0; i < coarse.length; i += 9) {
        const isInside = [0, 3, 6].every((v) =>
            axes.every((axis, k) => Math.abs(axis.reduce((sum, u, a) => sum + u * (coarse[i + v + a] - center[a]), 0)) <= half[k]),
        );
        count += isInside ? 1 : 0;
    }
    return count;
}

export async function turns() {
    const page = await usualPage();
    await page.focus('#canvas');
    const answer = await answerAfter(page, async () => {
        for (const key of ['Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+PageUp']) await page.keyboard.press(key);
    });
    assert.match(answer.command, /--oriented=/);
    assertSame(answer, coarseFile);
    assert.equal(answer.inside, insidesOf(boxOf(answer)));
    assert.ok(answer.inside > 0 && answer.straddling > 0);
}

export async function turnsByHandle() {
    const page = await usualPage();
    await page.keyboard.press('Tab');
    await page.click('#mode [value=rotate]');
    const answer = await answerAfter(page, () => drag(page, ON_RING, [317, 129]));
    assert.match(answer.command, /--oriented=/, 'the handle of the first view was missed');
    assertSame(answer, coarseFile);
}

export async function takesNumbers() {
    const page = await usualPage();
    for (const text of ['0.1,-0.3,-0.7,1.5,1.25,0.3', '2 0 0 2.5 0.5 0.25', '1,1,0,1,0.5,0.25,0.8,0.6,0,-0.6,0.8,0,0,0,1']) {
        const answer = await answerAfter(page, () => page.fill('#numbers', text).then(() => page.press('#numbers', 'Enter')));
        assert.equal(boxOf(answer).join(), text.replaceAll(' ', ','));
        assertSame(answer, coarseFile);
    }
    const turned = '1,1,0,1,-0.5,0.25,0.8,0.6,0,-0.6,0.8,0,0,0,1';
    for (const [text, why] of [
        ['1,1,1,0,0,0', 'lower exceeds upper on x'], ['0,0,0,1,1,-1', 'lower exceeds upper on z'],
        [turned, 'half length less than 0 on y'],
        ['1,2,3', 'six numbers are wanted, the lower corner and then the upper: 0,0,0,1,1,1'],
    ]) {
        await page.fill('#numbers', text);
        await page.press('#numbers', 'Enter');
        assert.equal(await page.textContent('#message'), `"${text}" is not a box: ${why}`);
        assert.equal(await page.getAttribute('#numbers', 'aria-invalid'), 'true');
    }
    await answerAfter(page, () => page.$eval('#reset', (button) => button.click())); // the focus stays
    assert.ok(await page.isHidden('#message'), 'the message stays above the next answer');
}

export async function everyTest() {
    const page = await usualPage();
    for (const [accuracy, axes, order] of [
        ['conservative', [1, 2, 4], '312'], ['fast', [1], '0'], ['exact', [2, 4], '231'], ['exact', [4], '321'],
    ]) {
        await page.click(`#accuracy [value=${accuracy}]`);
        for (const axis of [1, 2, 4]) await page.locator(`[name=axes][value="${axis}"]`).setChecked(true);
        for (const axis of [1, 2, 4]) await page.locator(`[name=axes][value="${axis}"]`).setChecked(axes.includes(axis));
        await page.selectOption('#order', order);
        await settled(page);
        const answer = await answerOf(page);
        assertSame(answer, coarseFile, ['--kernel', 'scalar']);
        assert.equal(answer.command.includes('--axes'), axes.length < 3);
    }
}

export async function indexAnswersAlike() {
    const page = await usualPage(), { straddling, inside } = await answerOf(page);
    await page.check('#by-index');
    await page.waitForFunction(() => document.getElementById('rate').textContent.startsWith('by the index'));
    const answer = await answerOf(page);
    assert.deepEqual([answer.straddling, answer.inside], [straddling, inside]);
    await page.focus('#canvas');
    assertSame(await answerAfter(page, () => page.keyboard.press('ArrowLeft')), coarseFile);
}

export async function playsAndStops() {
    const page = await usualPage();
    const { command } = await answerOf(page);
    await page.click('#play');
    await page.waitForFunction((old) => document.getElementById('command').textContent !== old, command);
    assert.equal(await page.getAttribute('#play', 'aria-pressed'), 'true');
    await page.click('#play');
    await settled(page);
    const answer = await answerOf(page);
    assert.notEqual(boxOf(answer).join(), '0.2,-0.6,-1,2.2,1.4,1');
    assertSame(answer, coarseFile);
    await answerAfter(page, () => page.click('#reset'));
    assert.equal(boxOf(await answerOf(page)).join(), '0.2,-0.6,-1,2.2,1.4,1');
}

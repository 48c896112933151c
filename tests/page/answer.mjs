// answer.mjs - what the page says, and what the program says to the same question.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';

const program = process.env.TRIBOX_PROGRAM || 'tribox';

/** All of it from one answer. */
export function answerOf(page) {
    return page.evaluate(() => {
        const text = (id) => document.getElementById(id).textContent;
        const count = (id) => Number(text(id).replaceAll(',', ''));
        return {
            command: text('command'),
            straddling: count('straddling'),
            inside: count('inside'),
            missed: count('missed'),
            unlike: count('unlike'),
            numbers: text('unlike-numbers').split(' ').filter(Boolean).map(Number),
            rate: text('rate'),
            time: text('time'),
        };
    });
}

/** Does something, and waits until the page has asked something else than before. */
export async function answerAfter(page, act) {
    const before = (await answerOf(page)).command;
    await act();
    await page.waitForFunction((old) => document.getElementById('command').textContent !== old, before);
    await settled(page);
    return answerOf(page);
}

/** Until three looks in a row see the same question. */
export async function settled(page) {
    for (let same = 0, last = ''; same < 3; await page.waitForTimeout(40)) {
        const { command } = await answerOf(page);
        same = command === last ? same + 1 : 0;
        last = command;
    }
}

/** Asserts again until it holds or ten seconds have passed: a picture is drawn when the machine has time. */
export async function soon(check) {
    for (const end = Date.now() + 10000; ; await new Promise((done) => setTimeout(done, 100))) {
        try {
            return await check();
        } catch (error) {
            if (Date.now() > end) throw error;
        }
    }
}

/** What the program prints as JSON. words: after `tribox`, with the mesh as the second. */
export function ask(words, mesh) {
    const [command, , ...options] = words;
    return JSON.parse(execFileSync(program, [command, mesh, ...options, '--json'], { encoding: 'utf8', maxBuffer: 1 << 28 }));
}

/** Asks the program the page's own question, about the same triangles in a file. */
export function assertSame(answer, mesh, more = []) {
    const words = [...answer.command.split(' ').slice(1), ...more], said = ask(words, mesh),
        place = `${words.join(' ')} of ${mesh}`;
    assert.equal(answer.straddling + answer.inside, said.overlapping, `overlapping, ${place}`);
    assert.equal(answer.missed, said.triangles - said.overlapping, `missed, ${place}`);
    if (said.inside !== undefined) assert.equal(answer.inside, said.inside, `inside, ${place}`);
    return said;
}

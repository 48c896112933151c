// test_files.mjs - files are dropped: right ones, unusual ones of which no triangle is lost or moved, and damaged ones.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { answerAfter, answerOf, ask, assertSame, settled } from './answer.mjs';
import { dropFile, usualPage } from './browser.mjs';
import { everyKind, folder, glbBytes, plyBytes, raw, small, stlBytes, write } from './meshes.mjs';

const moved = (triangles, by) => Float32Array.from(triangles, (x, i) => x + by[i % 3]);
const together = (...parts) => Float32Array.from(parts.flatMap((part) => Array.from(part)));

/** With a coordinate that is not finite. */
function broken(triangles) {
    const copy = triangles.slice();
    copy[4] = NaN;
    return copy;
}

/** Two nodes have one mesh. */
function nodes(offsets) {
    const content = glbBytes(small, (json) => {
        json.nodes = offsets.map((translation) => ({ mesh: 0, translation }));
        json.scenes[0].nodes = [0, 1];
    });
    return [content, together(...offsets.map((by) => moved(small, by)))];
}

/** Two primitives share positions; the second takes every triangle backwards. */
function primitives() {
    const vertices = small.length / 3, indices = Uint32Array.from({ length: vertices }, (_, i) => vertices - 1 - i);
    const bytes = new Uint8Array(small.byteLength + indices.byteLength);
    bytes.set(new Uint8Array(small.buffer));
    bytes.set(new Uint8Array(indices.buffer), small.byteLength);
    const content = glbBytes(bytes, (json) => {
        json.nodes[0].translation = [1, 0, 0];
        json.bufferViews[0].byteLength = small.byteLength;
        json.bufferViews.push({ buffer: 0, byteOffset: small.byteLength, byteLength: indices.byteLength });
        json.accessors[0].count = vertices;
        json.accessors.push({ bufferView: 1, componentType: 5125, count: vertices, type: 'SCALAR' });
        json.meshes[0].primitives.push({ attributes: { POSITION: 0 }, indices: 1 });
    });
    const once = moved(small, [1, 0, 0]);
    return [content, together(once, once)];
}

/** KHR_mesh_quantization: whole numbers, which the node scales. */
function wholeNumbers() {
    const whole = new Uint16Array((4 * small.length) / 3); // each vertex with a fourth, for it to be of 8 bytes
    small.forEach((x, i) => (whole[4 * Math.floor(i / 3) + (i % 3)] = 8192 * (x + 4)));
    const content = glbBytes(whole, (json) => {
        json.extensionsUsed = json.extensionsRequired = ['KHR_mesh_quantization'];
        Object.assign(json.nodes[0], { scale: [1 / 8192, 1 / 8192, 1 / 8192], translation: [-4, -4, -4] });
        json.bufferViews[0].byteStride = 8;
        const range = { min: [0, 0, 0], max: [65535, 65535, 65535] };
        Object.assign(json.accessors[0], { componentType: 5123, count: small.length / 3, ...range });
    });
    return [content, Float32Array.from(small, (_, i) => whole[4 * Math.floor(i / 3) + (i % 3)] / 8192 - 4)];
}

const far = small.map((x) => Math.fround(x + 557820)); // from the origin
const NOT_FINITE = /420 triangles\. 1 have coordinates that are not finite/;

/** Name, what is in the file, its triangles, and a note. */
const right = [
    ...everyKind(small).map(({ name, path }) => [name, readFileSync(path), small]),
    ['far.stl', stlBytes(broken(far)), broken(far), NOT_FINITE],
    ['nodes.glb', ...nodes([[1, 0, 0], [0, 2, 0]])],
    ['primitives.glb', ...primitives()],
    ['whole.glb', ...wholeNumbers()],
];

export async function rightFiles() {
    const page = await usualPage();
    for (const [name, content, triangles, note] of right) {
        const answer = await answerAfter(page, () => dropFile(page, name, content));
        assert.ok(await page.isHidden('#message'), await page.textContent('#message'));
        assert.ok(answer.command.startsWith(`tribox overlap ${name} `), answer.command);
        assert.equal(answer.straddling + answer.inside + answer.missed, triangles.length / 9, name);
        assert.ok(answer.straddling > 0 || name === 'far.stl', name);
        const said = assertSame(answer, raw('expected.f32', triangles));
        if (triangles === small && !name.endsWith('.glb'))
            assert.equal(ask(answer.command.split(' ').slice(1), write(name, content)).overlapping, said.overlapping);
        if (note) assert.match(await page.textContent('#mesh-note'), note);
    }
}

export async function isOpenedByButton() {
    const page = await usualPage(), [{ name, path }] = everyKind(small);
    const answer = await answerAfter(page, () => page.setInputFiles('#file', path));
    assert.ok(answer.command.startsWith(`tribox overlap ${name} `));
    assertSame(answer, path);
}

/** What the program says of a file that it does not read. */
function refusal(path) {
    const { stderr, status } = spawnSync(process.env.TRIBOX_PROGRAM || 'tribox', ['overlap', path, '--box=0,0,0,1,1,1'], {
        encoding: 'utf8',
    });
    assert.equal(status, 1, path);
    return stderr.trimEnd().replace(/^tribox overlap: (error: )?/, '');
}

/** What the program's readers refuse is said as the program says it, with the name of the file; the rest by the page itself. */
export async function damagedFiles() {
    const stl = stlBytes(small), glb = glbBytes(small), off = 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n';
    const files = [
        ['mesh.step', 'ISO-10303-21;', /mesh\.step: not a kind of file .* Export the mesh as \.stl/],
        ['noending', 'x', /noending: not a kind of file/],
        ['empty.stl', '', /empty\.stl: the file is empty/],
        ['far.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 1e999\nf 1 2 3\n', /none of its triangles has finite coordinates/],
        ['cut.glb', glb.slice(0, 2000), /promises \d+ bytes and has 2000/],
        ['prose.glb', 'this is no glTF at all', /does not begin as a GLB file/],
        ['cut.stl', stl.slice(0, 1000)], ['cut.ply', plyBytes(small).slice(0, 20000)],
        ['prose.obj', 'It was a dark and stormy night.'], ['index.off', off], ['M\u00fcller mit Raum.off', 'OFF 1 1 1'],
    ];
    const page = await usualPage(), before = await answerOf(page);
    for (const [name, content, said] of files) {
        await page.evaluate(() => (document.getElementById('message').textContent = ''));
        await dropFile(page, name, content);
        await page
            .waitForFunction(() => document.getElementById('message').textContent).catch(() => assert.fail(`${name}: no message`));
        const message = await page.textContent('#message');
        if (said) assert.match(message, said);
        else assert.equal(message, refusal(write(name, content)).replace(`${folder}/`, ''));
        assert.ok(message.startsWith(`${name}: `), message);
    }
    await settled(page);
    assert.deepEqual(await answerOf(page).then(({ command, inside }) => [command, inside]), [before.command, before.inside]);
    await answerAfter(page, () => dropFile(page, 'good.stl', stl));
    assert.ok(await page.isHidden('#message'), 'the message stays though a file was read');
}

/** Left out unless TRIBOX_MESHES names a folder with them. Positions of doubles become floats in the page. */
export async function realMeshes() {
    const meshes = process.env.TRIBOX_MESHES;
    for (const name of meshes ? ['teapot.ply', 'suzanne.ply', 'stanford-bunny.ply', '1514499.stl'] : []) {
        const page = await usualPage(), path = join(meshes, name);
        const answer = await answerAfter(page, () => page.setInputFiles('#file', path));
        assertSame(answer, path);
    }
}

/** By their names, to be shown again. */
export async function filesStayInTheList() {
    const page = await usualPage(), half = small.slice(0, 9 * 210);
    const first = await answerAfter(page, () => dropFile(page, 'a.stl', stlBytes(small)));
    assert.equal(await page.inputValue('#scene'), 'file:a.stl');
    await answerAfter(page, () => dropFile(page, 'b.stl', stlBytes(half)));
    await answerAfter(page, () => dropFile(page, 'a.stl', stlBytes(small)));
    const names = await page.$$eval('#scene option', (all) => all.map(({ text }) => text).filter((text) => text.endsWith('.stl')));
    assert.deepEqual(names.filter((name) => name.length === 5), ['a.stl', 'b.stl']);
    await answerAfter(page, () => page.selectOption('#scene', 'file:b.stl'));
    const again = await answerAfter(page, () => page.selectOption('#scene', 'file:a.stl'));
    assert.deepEqual([again.straddling, again.inside], [first.straddling, first.inside]);
}

/** More triangles than the page takes, all of one polygon. */
export async function isTooLarge() {
    const page = await usualPage();
    await page.setInputFiles('#file', write('large.off', `OFF\n1 1 0\n0 0 0\n${9e6}${' 0'.repeat(9e6)}\n`));
    await page.waitForFunction(() => document.getElementById('message').textContent.startsWith('large.off: has more than 8 mill'));
}

// test_files.mjs - meshes are dropped, of every kind, whole and damaged.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { answerAfter, answerOf, ask, assertSame, settled } from './answer.mjs';
import { dropFile, usualPage } from './browser.mjs';
import { everyKind, folder, glbBytes, plyBytes, raw, small, stlBytes, stlText, write } from './meshes.mjs';

export async function everyKindOfFile() {
    const page = await usualPage(),
        file = raw('small.f32', small);
    for (const { name, path } of everyKind(small)) {
        const answer = await answerAfter(page, () => dropFile(page, name, readFileSync(path)));
        assert.ok(answer.command.startsWith(`tribox overlap ${name} `), answer.command);
        assert.ok(answer.straddling > 0);
        const said = assertSame(answer, file);
        if (!name.endsWith('.glb')) assert.equal(ask(answer.command.split(' ').slice(1), path).overlapping, said.overlapping);
    }
    assert.ok(await page.isHidden('#message'));
}

export async function isOpenedByButton() {
    const page = await usualPage(),
        [{ name, path }] = everyKind(small);
    const answer = await answerAfter(page, () => page.setInputFiles('#file', path));
    assert.ok(answer.command.startsWith(`tribox overlap ${name} `));
    assertSame(answer, path);
}

/** Far from the origin, with a triangle that is not finite. */
export async function farMesh() {
    const far = small.map((x) => Math.fround(x + 557820));
    far[4] = NaN;
    const page = await usualPage(),
        answer = await answerAfter(page, () => dropFile(page, 'far.stl', stlBytes(far)));
    assertSame(answer, raw('far.f32', far));
    assert.match(await page.textContent('#mesh-note'), /far\.stl: 420 triangles\. 1 have coordinates that are not finite/);
}

/** What the program says of a file that it does not read. */
function refusal(path) {
    const { stderr, status } = spawnSync(process.env.TRIBOX_PROGRAM || 'tribox', ['overlap', path, '--box=0,0,0,1,1,1'], {
        encoding: 'utf8',
    });
    assert.equal(status, 1, path);
    return stderr.trimEnd().replace(/^tribox overlap: (error: )?/, '');
}

/** Said as the program says it, but for what it reads by libassimp. */
export async function damagedFiles() {
    const text = (...lines) => `${lines.join('\n')}\n`,
        stl = stlBytes(small),
        glb = glbBytes(small);
    const ply = text(
        'ply',
        'format ascii 1.0',
        'element vertex 3',
        'property float x',
        'property float y',
        'property float z',
        'element face 1',
        'property list uchar int vertex_indices',
        'end_header',
        '0 0 0',
        '1 0 0',
        '0 1 0',
    );
    const points = ['0 0 0', '1 0 0', '0 1 0', '1 1 0', '0 0 1', '1 0 1', '0 1 1', '1 1 1'];
    const cutCubes = [11, 8, 6, 4].map((faces) => [
        `cube_${faces}.off`,
        text('OFF', '8 12 0', ...points, ...Array(faces).fill('3 0 1 2')),
    ]);
    const files = [
        ['mesh.step', 'ISO-10303-21;', /mesh\.step: not a kind of file .* Export the mesh as \.stl/],
        ['noending', 'x', /noending: not a kind of file/],
        ['empty.stl', '', /empty\.stl: the file is empty/],
        ['far.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 1e999\nf 1 2 3\n', /none of its triangles has finite coordinates/],
        ['cut.glb', glb.slice(0, 2000), /promises \d+ bytes and has 2000/],
        ['prose.glb', 'this is no glTF at all', /does not begin as a GLB file/],
        ['short.stl', stl.slice(0, 40)],
        ['cut.stl', stl.slice(0, 1000)],
        ['long.stl', Uint8Array.of(...stl, 0)],
        ['cut_text.stl', 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n'],
        ['points.obj', 'v 0 0 0\nv 1 0 0\n'],
        ['prose.obj', 'It was a dark and stormy night.'],
        ['index.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n'],
        ['cut.ply', ply],
        ['cut_binary.ply', plyBytes(small).slice(0, 20000)],
        ['index.ply', `${ply}3 0 1 7\n`],
        ['type.ply', ply.replace('float x', 'real x')],
        ['prose.ply', 'no header'],
        ['zero.stl', stlText(small).replace(/(vertex \S+) \S+/, '$1 zero')],
        ['two.stl', stlText(small).replace(/vertex.*\n/, '')],
        ['junk.stl', stlText(small).replace('endsolid', 'endsolid x\nfacet\nendsolid')],
        ['blank.off', ' \n\n'],
        ...cutCubes,
        ['cut.off', text('OFF', '3 1 0', '0 0 0', '1 0 0')],
        ['index.off', text('OFF', '3 1 0', '0 0 0', '1 0 0', '0 1 0', '3 0 1 3')],
        ['word.off', text('OFF', '3 1 0', '0 0 zero', '1 0 0', '0 1 0', '3 0 1 2')],
        ['M\u00fcller mit Raum.off', 'OFF 1 1 1'],
    ];
    const page = await usualPage(),
        before = await answerOf(page);
    for (const [name, content, said] of files) {
        await page.evaluate(() => (document.getElementById('message').textContent = ''));
        await dropFile(page, name, content);
        await page
            .waitForFunction(() => document.getElementById('message').textContent)
            .catch(() => assert.fail(`${name}: no message`));
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

/** A pentagon and a triangle, big-endian and with a colour: four triangles. */
export async function polygonsBecomeFans() {
    const header =
        'ply\nformat binary_big_endian 1.0\nelement vertex 5\nproperty uchar red\nproperty float x\nproperty float y\n' +
        'property float z\nelement face 2\nproperty list uchar ushort vertex_index\nend_header\n';
    const points = [
            [0, 0, 0],
            [2, 0, 0],
            [3, 1, 0],
            [1, 2, 0],
            [-1, 1, 0],
        ],
        faces = [[0, 1, 2, 3, 4], [0, 1, 3]];
    const bytes = new Uint8Array(header.length + 5 * 13 + 11 + 7),
        view = new DataView(bytes.buffer);
    bytes.set(new TextEncoder().encode(header));
    let at = header.length;
    for (const point of points) {
        point.forEach((number, a) => view.setFloat32(at + 1 + 4 * a, number));
        at += 13;
    }
    for (const face of faces) {
        view.setUint8(at, face.length);
        face.forEach((v, k) => view.setUint16(at + 1 + 2 * k, v));
        at += 1 + 2 * face.length;
    }
    const fans = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 1, 3]].flatMap((fan) => fan.flatMap((v) => points[v]));
    const page = await usualPage(),
        answer = await answerAfter(page, () => dropFile(page, 'pentagon.ply', bytes));
    assert.equal(answer.straddling + answer.inside + answer.missed, 4);
    assertSame(answer, raw('pentagon.f32', Float32Array.from(fans)));
}

/** Left out unless TRIBOX_MESHES names a folder with them. Positions of doubles become floats in the page. */
export async function realMeshes() {
    const meshes = process.env.TRIBOX_MESHES;
    for (const name of meshes ? ['teapot.ply', 'suzanne.ply', 'stanford-bunny.ply', '1514499.stl'] : []) {
        const page = await usualPage(),
            path = join(meshes, name);
        const answer = await answerAfter(page, () => page.setInputFiles('#file', path));
        assertSame(answer, path);
    }
}

/** By their names, to be shown again. */
export async function filesStayInTheList() {
    const page = await usualPage(),
        half = small.slice(0, 9 * 210);
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

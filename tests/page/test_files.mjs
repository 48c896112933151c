// test_files.mjs - meshes are dropped, of every kind, whole and damaged.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { answerAfter, answerOf, ask, assertSame, settled } from './answer.mjs';
import { usualPage } from './browser.mjs';
import { dropFile } from './drop.mjs';
import { everyKind, glbBytes, plyBytes, raw, small, stlBytes } from './meshes.mjs';

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
    const pentagon = ply.replace('vertex 3', 'vertex 5').replace('0 1 0\n', '0 1 0\n2 2 0\n3 3 0\n5 0 1 2 3 4\n');
    const files = [
        ['mesh.step', 'ISO-10303-21;', /mesh\.step: not a kind of file .* Export the mesh as \.stl/],
        ['noending', 'x', /noending: not a kind of file/],
        ['empty.stl', '', /empty\.stl: the file is empty/],
        ['short.stl', stl.slice(0, 40), /ends after 40 bytes, within the header/],
        ['cut.stl', stl.slice(0, 1000), /header promises 420 triangles, and the file has room for 18/],
        ['cut_text.stl', 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n', /ends before the line endsolid/],
        ['points.obj', 'v 0 0 0\nv 1 0 0\n', /holds no triangles/],
        ['prose.obj', 'It was a dark and stormy night.', /no vertices/],
        ['far.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n', /none of its triangles has finite coordinates/],
        ['cut.ply', ply, /header promises 4 lines, and there are 3/],
        ['cut_binary.ply', plyBytes(small).slice(0, 20000), /ends before all that its header promises/],
        ['pentagon.ply', pentagon, /faces of more than four corners/],
        ['index.ply', `${ply}3 0 1 7\n`, /refers to vertex 7, and there are 3/],
        ['prose.ply', 'no header', /does not begin with ply/],
        ['cut.off', text('OFF', '3 1 0', '0 0 0', '1 0 0'), /ends before vertex 2/],
        ['index.off', text('OFF', '3 1 0', '0 0 0', '1 0 0', '0 1 0', '3 0 1 3'), /face 0, "3 0 1 3", does not name vertices/],
        ['word.off', text('OFF', '3 1 0', '0 0 zero', '1 0 0', '0 1 0', '3 0 1 2'), /"zero" in place of a number: vertex 0/],
        ['coff.off', text('COFF', '3 1 0', '0 0 0 1 1 1 1'), /of the kind COFF/],
        ['cut.glb', glb.slice(0, 2000), /promises \d+ bytes and has 2000/],
        ['prose.glb', 'this is no glTF at all', /does not begin as a GLB file/],
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
        assert.match(message, said);
        assert.ok(message.startsWith(`${name}: `), message);
    }
    await settled(page);
    assert.deepEqual(await answerOf(page).then(({ command, inside }) => [command, inside]), [before.command, before.inside]);
    await answerAfter(page, () => dropFile(page, 'good.stl', stl));
    assert.ok(await page.isHidden('#message'), 'the message stays though a file was read');
}

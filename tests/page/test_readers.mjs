// test_readers.mjs - files that are right and unusual: no triangle of them is lost or moved.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { answerAfter, assertSame } from './answer.mjs';
import { dropFile, usualPage } from './browser.mjs';
import { everyKind, glbBytes, raw, small, stlText, write } from './meshes.mjs';

const moved = (triangles, by) => Float32Array.from(triangles, (x, i) => x + by[i % 3]);
const together = (...parts) => Float32Array.from(parts.flatMap((part) => Array.from(part)));
const contentOf = (name) => readFileSync(everyKind(small).find((file) => file.name === name).path, 'utf8');

async function assertRead(name, content, triangles) {
    const page = await usualPage(),
        answer = await answerAfter(page, () => dropFile(page, name, content));
    assert.ok(await page.isHidden('#message'), await page.textContent('#message'));
    assert.ok(answer.straddling > 0);
    assertSame(answer, raw('expected.f32', triangles));
    return page;
}

export async function nodesShareMesh() {
    const offsets = [[1, 0, 0], [0, 2, 0]];
    const content = glbBytes(small, (json) => {
        json.nodes = offsets.map((translation) => ({ mesh: 0, translation }));
        json.scenes[0].nodes = [0, 1];
    });
    await assertRead('nodes.glb', content, together(...offsets.map((by) => moved(small, by))));
}

/** The second takes every triangle backwards. */
export async function primitivesSharePositions() {
    const vertices = small.length / 3,
        indices = Uint32Array.from({ length: vertices }, (_, i) => vertices - 1 - i);
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
    await assertRead('primitives.glb', content, together(once, once));
}

/** KHR_mesh_quantization: whole numbers, which the node scales. */
export async function positionsAreWholeNumbers() {
    const whole = new Uint16Array((4 * small.length) / 3); // each vertex with a fourth, for it to be of 8 bytes
    small.forEach((x, i) => (whole[4 * Math.floor(i / 3) + (i % 3)] = 8192 * (x + 4)));
    const content = glbBytes(whole, (json) => {
        json.extensionsUsed = json.extensionsRequired = ['KHR_mesh_quantization'];
        Object.assign(json.nodes[0], { scale: [1 / 8192, 1 / 8192, 1 / 8192], translation: [-4, -4, -4] });
        json.bufferViews[0].byteStride = 8;
        const range = { min: [0, 0, 0], max: [65535, 65535, 65535] };
        Object.assign(json.accessors[0], { componentType: 5123, count: small.length / 3, ...range });
    });
    await assertRead('whole.glb', content, Float32Array.from(small, (_, i) => whole[4 * Math.floor(i / 3) + (i % 3)] / 8192 - 4));
}

export async function headerIsNotAscii() {
    const comment = `comment by ${'M\u00fcller '.repeat(100)}`;
    await assertRead('mueller.ply', contentOf('text.ply').replace('element', `${comment}\nelement`), small);
}

export async function textStlHasNan() {
    const triangles = small.slice();
    triangles[3] = NaN;
    const page = await assertRead('nan.stl', stlText(triangles), triangles);
    assert.match(await page.textContent('#mesh-note'), /420 triangles\. 1 have coordinates that are not finite/);
}

export const objHasLooseEdge = () => assertRead('edge.obj', `${contentOf('mesh.obj')}l 1 4\nl 1 \\\n4\np 3\n`, small);

/** Far more triangles than the page takes, all of one polygon. */
async function assertTooLarge(name, content) {
    const page = await usualPage();
    await page.evaluate(() => (document.getElementById('message').textContent = ''));
    await page.setInputFiles('#file', write(name, content));
    await page.waitForFunction(() => document.getElementById('message').textContent);
    const message = await page.textContent('#message');
    assert.ok(message.startsWith(`${name}: has more than 8 million triangles`), message);
}

export async function plyIsTooLarge() {
    const corners = 16e6,
        header =
            'ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\n' +
            'element face 1\nproperty list uint uchar vertex_indices\nend_header\n\0\0\0';
    const ply = Buffer.alloc(header.length + 4 + corners);
    ply.write(header);
    ply.writeUInt32LE(corners, header.length);
    await assertTooLarge('large.ply', ply);
}

export const offIsTooLarge = () => assertTooLarge('large.off', `OFF\n1 1 0\n0 0 0\n${16e6}${' 0'.repeat(16e6)}\n`);

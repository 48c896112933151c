// package.test.mjs - what is packed: its files, its size, its types; and that it runs where nothing else is installed.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { copyFileSync, cpSync, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { folder, load, middleBox, randomPositions } from './package_under_test.mjs';

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, '../..');
const source = path.join(root, 'packaging/npm');
const textOf = (...names) => readFileSync(path.join(...names), 'utf8');
const manifest = JSON.parse(textOf(folder, 'package.json'));

const npm = (cwd, ...words) =>
    execFileSync('npm', [...words, '--offline', '--no-audit', '--no-fund', '--loglevel=error'], { cwd, encoding: 'utf8' });

/** Runs work in an empty folder. */
async function inFolder(work) {
    const made = mkdtempSync(path.join(tmpdir(), 'tribox-npm-'));
    try {
        return await work(made);
    } finally {
        rmSync(made, { recursive: true });
    }
}

/** Packs the package and installs it where nothing else is. */
const installed = (work) => inFolder(async (made) => {
    const [{ filename }] = JSON.parse(npm(folder, 'pack', '--json', '--pack-destination', made));
    writeFileSync(path.join(made, 'package.json'), '{"private": true, "type": "module"}');
    npm(made, 'install', `./${filename}`);
    return work(made);
});

test('tribox.wasm wants nothing of its host but a taker of bricks', () => {
    const module = new WebAssembly.Module(readFileSync(path.join(folder, 'tribox.wasm')));
    assert.deepEqual(WebAssembly.Module.imports(module), [{ module: 'tribox', name: 'take', kind: 'function' }]);
    assert.deepEqual(WebAssembly.Module.customSections(module, 'name'), []);
});

test('exports the functions that the module calls, and no others', () => {
    const parts = readdirSync(path.join(source, 'parts')).map((name) => textOf(source, 'parts', name));
    const text = [...parts, textOf(source, 'tribox.mjs')].join('\n');
    const exports = WebAssembly.Module.exports(new WebAssembly.Module(readFileSync(path.join(folder, 'tribox.wasm'))));
    // Soups and meshes share the calls of triangles.call().
    const shared = [...text.matchAll(/riangles\.call\(memory, '(\w+)'|this\.call\(memory, (?:isTurned \? '(\w+)' : )?'(\w+)'/g)]
        .flatMap(([, ...names]) => names.filter(Boolean)).flatMap((name) => [`tribox_${name}`, `tribox_mesh_${name}`]);
    const called = [...text.matchAll(/exports\.([a-z_0-9]+)|'(tribox_[a-z_0-9]+[a-z])'/g)].map((match) => match[1] ?? match[2])
        .concat(shared);
    assert.deepEqual(exports.map(({ name }) => name).sort(), [...new Set(called)].sort());
});

test('is as large as its README says', () => {
    const files = readdirSync(folder, { recursive: true }).filter((name) => /\.(wasm|mjs)$/.test(name))
        .map((name) => readFileSync(path.join(folder, name)));
    const sum = (lengths) => lengths.reduce((all, length) => all + length, 0);
    const zipped = files.map((bytes) => gzipSync(bytes, { level: 9 }));
    const measured = [files, zipped].map((all) => sum(all.map((bytes) => bytes.length)));
    const stated = textOf(source, 'README.md').match(/loads (\d+) kB,[^:]*: (\d+) kB if each file/).slice(1).map(Number);
    measured.forEach((bytes, i) => assert.ok(Math.abs(bytes / 1e3 / stated[i] - 1) < 0.02, `${bytes} bytes, not ${stated[i]} kB`));
});

test('is built with further functions and sources', () => inFolder(async (made) => {
    const extra = path.join(made, 'extra.c'), out = path.join(made, 'package'), build = path.join(source, 'build.sh');
    writeFileSync(extra, `#include "tribox.h"
        TRIBOX_API unsigned count_far(const tribox_soup *soup);
        TRIBOX_API unsigned count_far(const tribox_soup *soup)
        {
            unsigned far = 0;
            for (size_t i = 0; i < soup->count; i++)
                far += soup->x[0][i] > 1;
            return far;
        }`);
    execFileSync('sh', [build, out, extra, 'count_far', 'tribox_mesh_overlap']);
    const tribox = await load(readFileSync(path.join(out, 'tribox.wasm'))), { exports } = tribox;
    const positions = randomPositions(500), soup = tribox.soup({ positions }), mask = tribox.mask(500);
    assert.equal(exports.count_far(soup.address), soup.x[0].filter((x) => x > 1).length);
    const box = exports.malloc(48), words = exports.malloc(64);
    new Float64Array(tribox.memory.buffer, box, 6).set([...middleBox.lo, ...middleBox.hi]);
    for (const indices of [null, Uint32Array.from({ length: 1500 }, (_, k) => k)]) {
        const mesh = tribox.mesh({ positions, indices });
        assert.equal(exports.tribox_mesh_overlap(mesh.address, box, 0, words, 0), 0);
        assert.deepEqual(new Uint32Array(tribox.memory.buffer, words, 16), soup.overlap(middleBox, { into: mask }).mask.words);
    }
    const failed = spawnSync('sh', [build, path.join(made, 'none'), 'tribox_overlap_boxes'], { encoding: 'utf8' });
    assert.notEqual(failed.status, 0);
    assert.match(failed.stderr, /tribox_overlap_boxes/);
    assert.ok(!existsSync(path.join(made, 'none')));
}));

test('is described for npm, and states the version once', () => {
    assert.deepEqual([manifest.name, manifest.type, manifest.license], ['tribox', 'module', 'MIT']);
    for (const kind of ['dependencies', 'devDependencies', 'peerDependencies', 'scripts'])
        assert.equal(manifest[kind], undefined);
    const version = execFileSync('sh', [path.join(root, 'packaging/version.sh')], { encoding: 'utf8' }).trim();
    assert.equal(manifest.version, version);
    for (const name of readdirSync(source, { recursive: true }).filter((name) => /\.(mjs|ts|in|sh)$/.test(name)))
        assert.ok(!textOf(source, name).includes(`"${version}"`), name);
});

test('packs these files', () => {
    const [{ files }] = JSON.parse(npm(folder, 'pack', '--dry-run', '--json'));
    assert.deepEqual(files.map((file) => file.path).sort(), [
        'LICENSE', 'README.md', 'package.json', ...readdirSync(path.join(source, 'parts')).map((name) => `parts/${name}`),
        'tribox.d.ts',
        'tribox.mjs', 'tribox.wasm'].sort());
    assert.ok(files.every((file) => file.mode === 0o644));
});

const compiler = process.env.TRIBOX_TYPESCRIPT;
const examples = [...textOf(source, 'README.md').matchAll(/```js\n([\s\S]*?)```/g)].map((match) => match[1]);

/** Runs an example of README.md, which says what it prints. */
function runExample(made, example, most) {
    assert.ok(example.trim().split('\n').length <= most);
    writeFileSync(path.join(made, 'example.mjs'), example);
    const ran = spawnSync(process.execPath, ['example.mjs'], { cwd: made, encoding: 'utf8' });
    assert.equal(ran.status, 0, ran.stderr);
    const expected = [...example.matchAll(/\/\/ (?:prints )(.*)/g)].map((match) => match[1]);
    assert.ok(expected.length > 0);
    assert.deepEqual(ran.stdout.trim().split('\n'), expected);
}

test('runs where it is installed, offline, as its README says', () => installed((made) => {
    runExample(made, examples[0], 20);
    runExample(made, examples.find((example) => example.includes('worker_threads')), 25);
    const required = createRequire(path.join(made, 'x.js'));
    assert.ok(required.resolve('tribox/tribox.wasm').endsWith('tribox.wasm'));
    assert.deepEqual(readdirSync(path.join(made, 'node_modules')).filter((name) => !name.startsWith('.')), ['tribox']);
}));

test("takes three.js's Box3 and BufferGeometry", () => installed((made) => {
    cpSync(path.join(compiler, 'node_modules/three'), path.join(made, 'node_modules/three'), { recursive: true });
    runExample(made, examples.find((example) => example.includes("'three'")), 10);
}));

test('has types that TypeScript takes', () => installed((made) => {
    copyFileSync(path.join(here, 'types.mts'), path.join(made, 'types.mts'));
    for (const way of ['nodenext', 'bundler']) {
        const compilerOptions = { noEmit: true, strict: true, noUncheckedIndexedAccess: true, types: [], target: 'esnext',
            skipDefaultLibCheck: true, lib: ['esnext', 'dom'], moduleResolution: way, module: way === 'bundler' ? 'esnext' : way };
        writeFileSync(path.join(made, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: ['types.mts'] }));
        const ran = spawnSync(process.execPath, [path.join(compiler, 'node_modules/typescript/bin/tsc')], {
            cwd: made, encoding: 'utf8' });
        assert.equal(ran.stdout, '', way);
        assert.equal(ran.status, 0, way);
    }
}));

test('has what its types say', async () => {
    const typescript = createRequire(path.join(compiler, 'x.js'))('typescript');
    const types = typescript.createSourceFile('tribox.d.ts', textOf(folder, 'tribox.d.ts'), typescript.ScriptTarget.Latest);
    const membersOf = (name) => types.statements.find((one) => one.name?.text === name).members.map((one) => one.name.text)
        .filter(Boolean);
    const tribox = await load(), soup = tribox.soup({ positions: new Float32Array(9) });
    const made = { Tribox: tribox, Soup: soup, Index: soup.index(), Mesh: tribox.mesh({ positions: new Float64Array(9) }),
        Mask: tribox.mask(1), Voxels: tribox.voxels({ origin: [0, 0, 0], cell: 1, size: [1, 1, 1] }), Triangles: soup,
        Classes: soup.classify({
            lo: [0, 0, 0], hi: [1, 1, 1] }), Overlap: soup.overlap({ lo: [0, 0, 0], hi: [1, 1, 1] }) };
    for (const [name, object] of Object.entries(made)) {
        const members = membersOf(name);
        assert.ok(members.length > 1, name);
        for (const member of [...members, ...('free' in object ? ['free', Symbol.dispose] : [])])
            assert.ok(member in object, `${name}.${String(member)}`);
    }
    const [, row] = textOf(folder, 'README.md').match(/\| `soup\.index\(\)` \| (.*) \|/), named = [...row.matchAll(/`(\w+)`/g)];
    assert.deepEqual(named.map((match) => match[1]).concat('triangles', 'update').sort(), membersOf('Index').sort());
    assert.deepEqual(Object.keys(made.Classes).sort(), [...membersOf('Classes'), ...membersOf('Overlap')].sort());
});

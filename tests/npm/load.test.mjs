// load.test.mjs - tribox.wasm comes from wherever a program has it, and Workers share the compiled module.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import path from 'node:path';
import test from 'node:test';
import { pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';
import { folder, load, middleBox, randomPositions, TriboxError } from './package_under_test.mjs';

const file = path.join(folder, 'tribox.wasm');
const bytes = readFileSync(file);
const positions = randomPositions(1000);

async function answers(source) {
    const tribox = await load(source);
    return Array.from(tribox.soup({ positions }).overlap(middleBox).mask.list());
}
const expected = await answers();

const ofType = (type, body = bytes) => new Response(body, { headers: { 'content-type': type } });

/** A server of tribox.wasm, and of nothing else. */
async function serving(work) {
    const server = createServer((request, response) => {
        const isThere = request.url === '/tribox.wasm';
        response.writeHead(isThere ? 200 : 404, { 'content-type': isThere ? 'application/wasm' : 'text/html' });
        response.end(isThere ? bytes : 'not here');
    });
    await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
    try {
        return await work(`http://127.0.0.1:${server.address().port}`);
    } finally {
        server.close();
    }
}

test('loads from a file, bytes, a module, a response', async () => {
    assert.ok(expected.length > 100);
    const slice = new Uint8Array(bytes.length + 8);
    slice.set(bytes, 8);
    for (const source of [pathToFileURL(file), pathToFileURL(file).href, bytes, Uint8Array.from(bytes).buffer, slice.subarray(8),
        new DataView(slice.buffer, 8), new WebAssembly.Module(bytes), ofType('application/wasm'),
        ofType('application/octet-stream'),
        Promise.resolve(ofType('application/wasm')), undefined])
        assert.deepEqual(await answers(source), expected);
});

test('loads from a server', () => serving(async (address) => {
    assert.deepEqual(await answers(`${address}/tribox.wasm`), expected);
    assert.deepEqual(await answers(new URL('tribox.wasm', address)), expected);
    assert.deepEqual(await answers(fetch(`${address}/tribox.wasm`)), expected);
    await assert.rejects(load(`${address}/other.wasm`), { name: 'TriboxError',
        message: /other\.wasm answers 404 Not Found: serve tribox/ });
}));

test('says what it cannot load', async () => {
    for (const source of [7, {}, null, [], true])
        await assert.rejects(load(source), { name: 'TypeError',
            message: /^source = .*: give an address, a Response, bytes or a WebAss/ });
    for (const address of ['tribox.wasm', './parts/tribox.wasm', file, ''])
        await assert.rejects(load(address), { name: 'TypeError',
            message: /^source = ".*" is no whole address: give a file: URL or/ });
    for (const broken of [new Uint8Array(), bytes.subarray(0, 9999), Uint8Array.of(0, 1, 2, 3),
        ofType('application/wasm', 'hello')])
        await assert.rejects(load(broken), (error) => error instanceof TriboxError &&
            /^tribox\.wasm does not compile: .*SIMD/.test(error.message)
            && error.cause instanceof WebAssembly.CompileError);
    const empty = new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0));
    await assert.rejects(load(empty), { name: 'TriboxError', message: /^source is another WebAssembly module/ });
    await assert.rejects(load(pathToFileURL(`${file}.none`)), /ENOENT/);
});

test('knows itself', async () => {
    const tribox = await load();
    const { version } = JSON.parse(readFileSync(path.join(folder, 'package.json')));
    assert.equal(tribox.version, version);
    assert.equal(tribox.kernel, 'wasm128');
    assert.throws(() => {
        tribox.version = '9';
    }, TypeError);
});

const worker = `
    import { parentPort, workerData } from 'node:worker_threads';
    const { load } = await import(workerData.package);
    const tribox = await load(workerData.module);
    const soup = tribox.soup({ positions: workerData.positions });
    parentPort.on('message', (box) => {
        const { overlapping, mask } = soup.overlap(box);
        parentPort.postMessage({ overlapping, words: mask.words }, [mask.words.buffer]);
    });
    parentPort.postMessage('ready');`;

test('shares of any size join as the README says', async () => {
    const example = readFileSync(path.join(folder, 'README.md'), 'utf8').match(/const share[^]*?\* k\)\);\n/)[0];
    const AsyncFunction = (async () => {}).constructor;
    const joined = new AsyncFunction('positions', 'workers', 'ask', `${example}return words;`);
    const tribox = await load(), ask = async (part) => tribox.soup({ positions: part }).overlap(middleBox).mask.words;
    for (const count of [0, 1, 63, 64, 65, 96, 128, 192, 300, 1000])
        for (const workers of [1, 2, 3, 4, 7]) {
            const some = positions.subarray(0, 9 * count), words = await joined(some, workers, ask), whole = await ask(some);
            assert.deepEqual(words.slice(0, whole.length), whole, `${count} triangles, ${workers} Workers`);
            assert.ok(words.subarray(whole.length).every((word) => word === 0));
        }
});

test('two Workers answer for half the triangles each', async () => {
    const { module } = await load(), split = 512 * 9;
    const heard = (one) => new Promise((resolve, reject) => one.once('message', resolve).once('error', reject));
    const workers = [positions.subarray(0, split), positions.subarray(split)].map((part) => new Worker(
        new URL(`data:text/javascript,${encodeURIComponent(worker)}`),
        { workerData: { package: pathToFileURL(path.join(folder, 'tribox.mjs')).href, module, positions: part.slice() } }));
    try {
        assert.deepEqual(await Promise.all(workers.map(heard)), ['ready', 'ready']);
        workers.forEach((one) => one.postMessage(middleBox));
        const parts = await Promise.all(workers.map(heard));
        const whole = (await load(module)).soup({ positions }).overlap(middleBox);
        assert.equal(parts[0].overlapping + parts[1].overlapping, whole.overlapping);
        assert.deepEqual([...parts[0].words, ...parts[1].words], [...whole.mask.words]);
    } finally {
        await Promise.all(workers.map((one) => one.terminate()));
    }
});

// tribox.mjs - loads tribox.wasm, and makes soups, meshes, masks and voxels in its memory. Types and manual: tribox.d.ts.
import { vector, whole } from './parts/arguments.mjs';
import { countOf } from './parts/bricks.mjs';
import { shown, TriboxError } from './parts/errors.mjs';
import { gridAroundBox } from './parts/grid.mjs';
import { Mask, maskWords } from './parts/mask.mjs';
import { Memory } from './parts/memory.mjs';
import { Mesh } from './parts/mesh.mjs';
import { soupOf, soupOfNaN } from './parts/soup.mjs';
import { voxelsIn } from './parts/voxels.mjs';

export { TriboxError };

const COUNT_MAX = 2 ** 32 - 1;

class Tribox {
    #memory;

    constructor(module, { exports }, takers) {
        this.#memory = new Memory(exports, takers);
        this.version = '@VERSION@';
        this.kernel = this.#memory.text(exports.tribox_kernel_name(0));
        this.module = module;
        this.memory = exports.memory;
        this.exports = exports;
        Object.freeze(this);
    }

    soup(mesh, options) {
        return soupOf(this.#memory, mesh, options);
    }

    allocSoup(length) {
        return soupOfNaN(this.#memory, whole(length, 'length', 0, COUNT_MAX));
    }

    mesh(mesh, options) {
        return new Mesh(this.#memory, mesh, options);
    }

    mask(length) {
        const memory = this.#memory, words = maskWords(whole(length, 'length', 0, COUNT_MAX));
        const address = memory.take(4 * words, `a mask of ${length} bits`);
        memory.words(address, words).fill(0);
        return new Mask(memory, address, length);
    }

    voxels(grid, window) {
        return voxelsIn(this.#memory, grid, window);
    }

    tileCount(size, side) {
        const cells = vector(size, 'size').map((number, a) => whole(number, `size[${a}]`, 0, COUNT_MAX));
        return countOf({ size: cells }, whole(side, 'side', 1, COUNT_MAX, 'the cells along a side of a tile'));
    }

    gridAround(box, cells) {
        return gridAroundBox(this.#memory, box, cells);
    }
}

/** The bytes of a file: engines that have no fetch of file: have this. */
function fileBytes(url) {
    return globalThis.process?.getBuiltinModule?.('node:fs').promises.readFile(url);
}

function fetched(url) {
    return (url.protocol === 'file:' && fileBytes(url)) || fetch(url);
}

async function compiled(response) {
    if (!response.ok)
        throw new TriboxError(`${response.url} answers ${response.status} ${response.statusText}: serve tribox.wasm there, ` +
            `or give ` +
            'load() its address or its bytes');
    if (response.headers.get('content-type') === 'application/wasm')
        return WebAssembly.compileStreaming(response);
    return WebAssembly.compile(await response.arrayBuffer());
}

async function moduleOf(source) {
    if (source instanceof WebAssembly.Module)
        return source;
    if (source instanceof ArrayBuffer)
        return WebAssembly.compile(source);
    if (ArrayBuffer.isView(source))
        return WebAssembly.compile(new Uint8Array(source.buffer, source.byteOffset, source.byteLength));
    if (source instanceof Response)
        return compiled(source);
    throw new TypeError(`source = ${shown(source)}: give an address, a Response, bytes or a WebAssembly.Module`);
}

function checkModule(module) {
    if (!WebAssembly.Module.exports(module).some(({ name }) => name === 'tribox_kernel_name'))
        throw new TriboxError('source is another WebAssembly module: give that of tribox.wasm');
}

/** Addresses may be relative to the page or the worker, where there is one. */
function addressOf(source) {
    try {
        return new URL(source, globalThis.document?.baseURI ?? globalThis.location?.href);
    } catch (error) {
        throw new TypeError(`source = ${shown(source)} is no whole address: give a file: URL or the bytes`, { cause: error });
    }
}

export async function load(source = new URL('./tribox.wasm', import.meta.url)) {
    const given = await source;
    try {
        const module = await moduleOf(typeof given === 'string' || given instanceof URL ? await fetched(addressOf(given)) : given);
        checkModule(module);
        const takers = [], take = (number, ...addresses) => takers[number](...addresses.map((at) => at >>> 0));
        return new Tribox(module, await WebAssembly.instantiate(module, { tribox: { take } }), takers);
    } catch (error) {
        if (error instanceof WebAssembly.CompileError)
            throw new TriboxError(`tribox.wasm does not compile: ${error.message}. It needs 128-bit SIMD (Chrome 91, Firefox 89, ` +
                'Safari 16.4, Node.js 16.4)', { cause: error });
        throw error;
    }
}

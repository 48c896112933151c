// memory.mjs - the memory of an instance: room in it, views of it, and the structures that calls in C read and write.
import { optionNumbers } from './arguments.mjs';
import { TriboxError } from './errors.mjs';

// Where each structure lies in a room that is taken once.
const OPTIONS = 0, REPORT = 32, NUMBER = 40, BOX = 48, GRID = 168, SOUP = 232, SMALL_BYTES = 272;

// sbrk of wasi-libc takes a signed number.
const BYTES_MAX = 2 ** 31 - 2 ** 20;

export class Memory {
    #small;

    constructor(exports) {
        this.exports = exports;
        this.#small = this.take(SMALL_BYTES, 'options');
        this.words(this.#small, SMALL_BYTES / 4).fill(0);
    }

    /** The address of a soup without triangles. */
    get emptySoup() {
        return this.#small + SOUP;
    }

    get buffer() {
        return this.exports.memory.buffer;
    }

    floats(address, length) {
        return new Float32Array(this.buffer, address, length);
    }

    words(address, length) {
        return new Uint32Array(this.buffer, address, length);
    }

    /** The address of so many bytes, which are not cleared. */
    take(bytes, what) {
        const address = bytes > BYTES_MAX ? 0 : this.exports.malloc(Math.max(bytes, 1)) >>> 0;
        if (!address)
            throw new TriboxError(`out of memory: ${what} would take ${(bytes / 2 ** 20).toFixed(1)} MiB; free() what is no longer ` +
                'needed, or ask for less (4 GiB in all, 2 GiB at once)');
        return address;
    }

    give(address) {
        this.exports.free(address);
    }

    /** Runs work(address) on room that is given back after it. */
    borrow(bytes, what, work) {
        const address = this.take(bytes, what);
        try {
            return work(address);
        } finally {
            this.give(address);
        }
    }

    text(address) {
        const bytes = new Uint8Array(this.buffer, address >>> 0);
        return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
    }

    /** Each of these writes a structure and returns its address. */
    options(options) {
        this.words(this.#small + OPTIONS, 4).set([...optionNumbers(options), 0]);
        return this.#small + OPTIONS;
    }

    box(numbers) {
        this.floats(this.#small + BOX, numbers.length).set(numbers);
        return this.#small + BOX;
    }

    boxOfDoubles(numbers) {
        new Float64Array(this.buffer, this.#small + BOX, 6).set(numbers);
        return this.#small + BOX;
    }

    grid({ origin, cell, size }) {
        this.floats(this.#small + GRID, 6).set([...origin, ...cell]);
        this.words(this.#small + GRID + 24, 3).set(size);
        return this.#small + GRID;
    }

    /** Where calls write their report, and what was written. */
    get report() {
        return this.#small + REPORT;
    }

    readReport() {
        const [overlapping, undecided] = this.words(this.report, 2);
        return { overlapping, undecided };
    }

    /** Where calls write a number, and that number. */
    get number() {
        return this.#small + NUMBER;
    }

    readNumber() {
        return this.words(this.number, 1)[0];
    }

    /** Calls a function of C that returns a tribox_status. */
    call(name, ...numbers) {
        const status = this.exports[name](...numbers);
        if (status)
            throw new TriboxError(`${name}: ${this.text(this.exports.tribox_status_text(status))}`);
    }
}

// memory.mjs - the memory of an instance: room in it, views of it, and the structures that calls in C read and write.
import { optionNumbers } from './arguments.mjs';
import { TriboxError } from './errors.mjs';

// Where each structure lies in a room that is taken once, and its bytes.
const BOX = 0, GRID = 120, CELL = 184, OPTIONS = 232, REPORT = 264, NUMBERS = 272, REGION = 280, WINDOW = 288, SOUP = 312,
    SMALL_BYTES = 352;
export const OPTIONS_BYTES = 32, GRID_BYTES = 64;

// sbrk of wasi-libc takes a signed number.
const BYTES_MAX = 2 ** 31 - 2 ** 20;

/** A number of bytes as people read it. */
function inUnits(bytes) {
    const units = ['MiB', 'GiB', 'TiB', 'PiB', 'EiB'], power = Math.floor(Math.log2(bytes / 2 ** 20) / 10);
    const n = Math.max(0, Math.min(power, units.length - 1));
    return `${Number((bytes / 2 ** (20 + 10 * n)).toPrecision(3))} ${units[n]}`;
}

export class Memory {
    #small;

    /** takers: what bricks are handed to, by the data of their sinks. */
    constructor(exports, takers) {
        this.exports = exports;
        this.takers = takers;
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

    doubles(address, length) {
        return new Float64Array(this.buffer, address, length);
    }

    words(address, length) {
        return new Uint32Array(this.buffer, address, length);
    }

    /** The address of so many bytes, which are not cleared. */
    take(bytes, what) {
        const address = bytes > BYTES_MAX ? 0 : this.exports.malloc(Math.max(bytes, 1)) >>> 0;
        if (!address)
            throw new TriboxError(`out of memory: ${what} would take ${inUnits(bytes)}; free() what is no longer ` +
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
    options(options, address = this.#small + OPTIONS) {
        this.words(address, OPTIONS_BYTES / 4).fill(0).set(optionNumbers(options));
        return address;
    }

    box(numbers) {
        this.doubles(this.#small + BOX, numbers.length).set(numbers);
        return this.#small + BOX;
    }

    /** Of the box, or the oriented one, at an address. */
    region(box, isOriented) {
        this.words(this.#small + REGION, 2).set(isOriented ? [0, box] : [box, 0]);
        return this.#small + REGION;
    }

    grid({ origin, cell, size }, address = this.#small + GRID) {
        this.doubles(address, 6).set([...origin, ...cell]);
        this.words(address + 48, 3).set(size);
        return address;
    }

    window({ first, size }) {
        this.words(this.#small + WINDOW, 6).set([...first, ...size]);
        return this.#small + WINDOW;
    }

    /** The box of a cell: the very one that is tested. */
    cellBox(grid, at) {
        const box = this.#small + CELL;
        this.exports.tribox_grid_cell(box, this.grid(grid), ...at);
        const numbers = Array.from(this.doubles(box, 6));
        return { lo: numbers.slice(0, 3), hi: numbers.slice(3) };
    }

    /** Where calls write their report, and what was written. */
    get report() {
        return this.#small + REPORT;
    }

    readReport() {
        const [overlapping, undecided] = this.words(this.report, 2);
        return { overlapping, undecided };
    }

    /** Where calls write a number, and the second one after it; and these numbers. */
    get number() {
        return this.#small + NUMBERS;
    }

    readNumber(place = 0) {
        return this.words(this.number, 2)[place];
    }

    /** Calls a function of C that returns a tribox_status. */
    call(name, ...numbers) {
        const status = this.exports[name](...numbers);
        if (status)
            throw new TriboxError(`${name}: ${this.text(this.exports.tribox_status_text(status))}`);
    }
}

// held.mjs - something that lies in the memory of an instance until it is freed.
import { TriboxError } from './errors.mjs';

export class Held {
    #memory;
    #rooms;
    #name;

    /** rooms: the addresses to give back. */
    constructor(memory, rooms, name) {
        this.#memory = memory;
        this.#rooms = rooms;
        this.#name = name;
    }

    /** The memory, as long as there is something in it. */
    get held() {
        if (!this.#rooms)
            throw new TriboxError(`this ${this.#name} was freed`);
        return this.#memory;
    }

    /** Whether it lies in that memory. */
    isIn(memory) {
        return this.held === memory && this.#rooms.length > 0;
    }

    free() {
        this.#rooms?.forEach((address) => this.#memory.give(address));
        this.#rooms = null;
    }

    // Engines that do not know `using` have no such symbol.
    [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
        this.free();
    }
}

// triangles.mjs - what soups and meshes are asked and make alike, but for the names of the calls.
import { oneOf } from './arguments.mjs';
import { bricks, tileLists } from './bricks.mjs';
import { boundsOf } from './grid.mjs';
import { Index } from './mesh_index.mjs';
import { placeIn, Questions } from './questions.mjs';
import { cellLists, fillParity, voxelize } from './voxels.mjs';

const whats = ['hit', 'miss'];

/** A subclass has address, length, ids and reader(). */
export class Triangles extends Questions {
    #prefix;

    /** prefix: what the names of the calls begin with. */
    constructor(memory, room, name, prefix) {
        super(memory, [room], name);
        this.#prefix = prefix;
    }

    /** Makes a call of this kind of triangles. */
    call(memory, name, ...numbers) {
        memory.call(this.#prefix + name, this.address, ...numbers);
    }

    overlapInto({ memory, box, isTurned, options }, mask) {
        this.call(memory, isTurned ? 'overlap_oriented' : 'overlap', box, options, mask, memory.report);
    }

    classifyInto({ memory, box, options }, mask, inside) {
        this.call(memory, 'classify', box, options, mask, inside, memory.report);
    }

    find(box, options) {
        const { memory, box: at, options: address } = this.uprightQuestion(box, options, ['what']);
        this.call(memory, 'find', at, address, whats.indexOf(oneOf(options?.what ?? 'hit', 'options.what', whats)), memory.number);
        return placeIn(memory, this.length);
    }

    voxelize(grid, options) {
        return voxelize(this.held, this, grid, options);
    }

    fillParity(voxels) {
        return fillParity(this.held, this, voxels);
    }

    tileLists(grid, tiles, options) {
        return tileLists(this.held, this, grid, tiles, options);
    }

    cellLists(grid, options) {
        return cellLists(this.held, this, grid, options);
    }

    bricks(grid, tiles, take, options) {
        return bricks(this.held, this, grid, tiles, take, options);
    }

    index() {
        return new Index(this.held, this);
    }

    bounds() {
        void this.held;
        return boundsOf(this.reader(), this.length);
    }
}

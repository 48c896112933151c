// library.js - tribox over one part of a mesh, in one instance of the wasm.
import { load } from 'tribox';
import { visitsOf } from './visits.js';

const GROUPS = [[1, 'box'], [2, 'plane'], [4, 'edges']];

const optionsOf = ({ accuracy, axes, order }) => ({
    accuracy,
    axes: GROUPS.filter(([bit]) => axes & bit).map(([, word]) => word),
    ...(order && { axisOrder: order }),
});

const orientedOf = ({ center, half, axes }) => ({ center, half, axis: [axes.slice(0, 3), axes.slice(3, 6), axes.slice(6)] });

export class Library {
    static async open(module) {
        const library = new Library();
        library.tribox = await load(module);
        return library;
    }

    get kernel() {
        return this.tribox.kernel;
    }

    /** triangles: nine floats each, in the order of the file. */
    load(triangles) {
        for (const held of [this.index, this.sorted, this.soup, this.mask, this.insideMask, this.other]) held?.free();
        this.index = this.sorted = null;
        this.triangles = triangles;
        this.count = triangles.length / 9;
        this.soup = this.tribox.soup({ positions: triangles });
        for (const name of ['mask', 'insideMask', 'other']) this[name] = this.tribox.mask(this.count);
    }

    /** Near triangles become near in number, in a copy: what an index wants. */
    buildIndex() {
        this.sorted ??= this.tribox.soup({ positions: this.triangles }, { sort: true });
        this.index ??= this.sorted.index();
    }

    /** Which triangles overlap the box, to `mask`. */
    ask(box, test, of = this.soup) {
        return of.overlap(box.turned ? orientedOf(box) : box, { ...optionsOf(test), into: this.mask }).undecided;
    }

    /** The same by the index, in the order of its copy. */
    askIndex(box, test) {
        return this.ask(box, test, this.index);
    }

    /** Brings what the index answered into the order of the file. */
    putInFileOrder() {
        const { ids } = this.sorted, from = this.mask.words.slice(), to = this.mask.words.fill(0);
        for (let w = 0; w < from.length; w++)
            for (let left = from[w]; left; left &= left - 1) {
                const triangle = ids[32 * w + 31 - Math.clz32(left & -left)];
                to[triangle >>> 5] |= 1 << (triangle & 31);
            }
    }

    /** What askIndex comes by. */
    visits(box) {
        const { memory } = this.tribox, [nodes] = new Uint32Array(memory.buffer, this.index.address, 1);
        return visitsOf(new Float32Array(memory.buffer, nodes), this.count, box);
    }

    /** What EXACT answers: words that the next call overwrites. */
    askExact(box, test) {
        const options = { ...optionsOf(test), accuracy: 'exact', into: this.other };
        this.soup.overlap(box.turned ? orientedOf(box) : box, options);
        return this.other.words;
    }

    /** Which triangles lie wholly inside the box, to `insideMask`: the same at every accuracy. */
    findInside(box) {
        if (box.turned) this.findInsideTurned(box);
        else this.soup.classify(box, { into: this.other, insideInto: this.insideMask });
    }

    /**
     * The library tells insides of upright boxes alone. A triangle is inside a turned one where its three vertices are: points, or
     * triangles of three equal vertices. By the axes of the box, which do for points.
     */
    findInsideTurned(box) {
        const box15 = orientedOf(box), points = this.tribox.allocSoup(this.count),
            inside = this.insideMask.words; // looked at last: room for the points may have moved it
        try {
            for (let vertex = 0; vertex < 3; vertex++) {
                for (const axis of ['x', 'y', 'z']) for (const stream of points[axis]) stream.set(this.soup[axis][vertex]);
                const found = points.overlap(box15, { axes: ['box'], into: this.other }).mask.words;
                if (vertex) for (let i = 0; i < inside.length; i++) inside[i] &= found[i];
                else inside.set(found);
            }
        } finally {
            points.free();
        }
    }

    /** The cells that these triangles mark, of a grid around a box: its words of 32 cells. */
    voxelize(bounds, resolution, test) {
        const grid = this.tribox.gridAround(bounds, { resolution });
        return { grid, bits: this.soup.voxelize(grid, optionsOf(test)).bits };
    }

    /** The paper's test reads nine floats a triangle, one after another: a copy for it alone. */
    openPaper() {
        const { exports, memory } = this.tribox, bytes = 4 * this.triangles.length;
        this.paper = exports.malloc(bytes + 24);
        if (!this.paper) throw new Error("no memory for the paper's copy of the mesh: take a smaller one");
        this.paperCount = this.count;
        new Float32Array(memory.buffer, this.paper + 24, this.triangles.length).set(this.triangles);
    }

    askPaper({ lo, hi }) {
        const { exports, memory } = this.tribox, numbers = new Float32Array(memory.buffer, this.paper, 6);
        numbers.set([...lo.map((l, a) => (l + hi[a]) / 2), ...lo.map((l, a) => (hi[a] - l) / 2)]);
        exports.paper_overlap(this.paper, this.paper + 12, this.paper + 24, this.paperCount, this.other.words.byteOffset);
    }

    closePaper() {
        this.tribox.exports.free(this.paper);
    }
}

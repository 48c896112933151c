// worker.js - answers questions about one part of a mesh, off the page's thread: messages in, messages out.
import { countBits } from './bits.js';
import { Library } from './library.js';
import { breathe, measure } from './measure.js';
import { serve } from './serve.js';

let library = null;

const SETTLE_MS = 150, ENOUGH_MS = 60;
let asked = 0; // questions so far: what takes its time gives way to the next

/** Runs a call again until it fills a millisecond, as clocks of browsers are coarse. Returns milliseconds a call. */
function time(call) {
    const start = performance.now();
    let calls = 0, passed = 0;
    do {
        call();
        calls++;
        passed = performance.now() - start;
    } while (passed < 1 && calls < 1000);
    return passed / calls;
}

serve(
    {
    async open({ module }) {
        library = await Library.open(module);
        return { kernel: library.kernel };
    },

    load({ triangles }) {
        library.load(triangles);
        return {};
    },

    ask({ box, test, byIndex }) {
        if (byIndex) library.buildIndex();
        const ask = byIndex ? () => library.askIndex(box, test) : () => library.ask(box, test);
        let undecided;
        const milliseconds = time(() => (undecided = ask()));
        if (byIndex) library.putInFileOrder();
        library.findInside(box);
        const mask = library.mask.words.slice(), inside = library.insideMask.words.slice();
        const unlike = test.accuracy === 'exact' ? null : library.askExact(box, test).slice();
        const visits = byIndex && !box.turned ? library.visits(box) : null;
        if (unlike) for (let i = 0; i < mask.length; i++) unlike[i] ^= mask[i];
        return { mask, inside, unlike, visits, milliseconds, undecided, overlapping: countBits(mask), insides: countBits(inside) };
    },

    /** The least time of the same question, once the browser has compiled its best; null if another question came. */
    async settle({ box, test, byIndex }) {
        const ask = byIndex ? () => library.askIndex(box, test) : () => library.ask(box, test);
        const start = performance.now(), mine = asked;
        let milliseconds = Infinity;
        while (performance.now() - start < SETTLE_MS) {
            milliseconds = Math.min(milliseconds, time(ask));
            await breathe();
            if (asked !== mine) return { milliseconds: null };
        }
        return { milliseconds };
    },

    /** The time is the least of ten, or of as many as there is patience for. */
    voxelize({ bounds, resolution, test }) {
        const start = performance.now();
        let cells = null, milliseconds = Infinity;
        for (let i = 0; i < 10 && (i === 0 || performance.now() - start < ENOUGH_MS); i++)
            milliseconds = Math.min(milliseconds, time(() => (cells = library.voxelize(bounds, resolution, test))));
        return { ...cells, milliseconds };
    },

    measure: ({ box, axes }, say) => measure(library, box, axes, say),
},
() => asked++,
);

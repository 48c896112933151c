// measure.js - times the paper's test and tribox's in turns, until the compiler of the browser has done its best.

/** Lets a Worker answer what else has come in, without the pauses that timers have. */
export const breathe = () =>
    new Promise((go) => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => {
            port1.close();
            go();
        };
        port2.postMessage(0);
    });

const ROUNDS = 15;
const WARM_MS = 800; // the least that browsers run code that they have compiled in a hurry
const MOST_MS = 3000;

/** Milliseconds a call, of as many calls as a coarse clock needs. */
function time(run, calls) {
    const start = performance.now();
    for (let i = 0; i < calls; i++) run();
    return (performance.now() - start) / calls;
}

/** Runs each until the best of its times no longer falls; how many calls make a time long enough for the clock. */
async function warmUp(contestants, pause) {
    const start = performance.now();
    let best = contestants.map(() => Infinity), calm = 0;
    for (let passed = 0; passed < MOST_MS && (passed < WARM_MS || calm < 3); passed = performance.now() - start) {
        const times = contestants.map((c) => time(c.run, c.calls));
        contestants.forEach((c, i) => {
            if (times[i] * c.calls < 2) c.calls = Math.min(1000, Math.ceil(2 / Math.max(times[i], 0.002)));
        });
        calm = times.every((t, i) => t > 0.97 * best[i]) ? calm + 1 : 0;
        best = best.map((b, i) => Math.min(b, times[i]));
        await pause();
    }
}

/** Lets other questions in; throws if one of them has put another mesh in place of the one that is measured. */
function pauseOf(library) {
    const { triangles } = library;
    return async () => {
        await breathe();
        if (library.triangles !== triangles) throw new Error('Another mesh was shown meanwhile. Press Measure again.');
    };
}

/** Nanoseconds a triangle, the least of rounds in which all take turns, as others on the machine only ever add to it. */
export async function measure(library, box, axes, say) {
    const contestants = [
        { name: 'paper', run: () => library.askPaper(box) },
        { name: 'exact', run: () => library.ask(box, { accuracy: 'exact', axes, order: 0 }) },
    ].map((c) => ({ ...c, calls: 1, times: [] }));
    const pause = pauseOf(library);
    library.openPaper();
    try {
        say({ stage: 'warming up' });
        await warmUp(contestants, pause);
        say({ stage: 'measuring' });
        for (let round = 0; round < ROUNDS; round++) {
            for (const c of contestants) c.times.push(time(c.run, c.calls));
            await pause();
        }
    } finally {
        library.closePaper();
    }
    const rows = contestants.map(({ name, times }) => ({ name, ns: (1e6 * Math.min(...times)) / library.count }));
    return { rows, rounds: ROUNDS, triangles: library.count };
}

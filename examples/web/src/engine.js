// engine.js - the Workers as one: deals a mesh out, asks each about its part, joins their answers.
import makerSource from 'built:maker';
import workerSource from 'built:worker';
import { joinBits, setBits } from './bits.js';

const urlOf = (source) => URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
const workerUrl = urlOf(workerSource), makerUrl = urlOf(makerSource);

/** One Worker, whose answers are promises. */
class Hand {
    constructor(url) {
        this.worker = new Worker(url, { name: 'tribox' });
        this.waiting = new Map();
        this.next = 0;
        this.worker.onmessage = ({ data: { id, answer, news, error } }) => {
            const asked = this.waiting.get(id);
            if (news !== undefined) return asked.onNews?.(news);
            this.waiting.delete(id);
            if (error) asked.fail(new Error(error));
            else asked.done(answer);
        };
        this.worker.onerror = (event) => {
            for (const asked of this.waiting.values()) asked.fail(new Error(event.message || 'a Worker could not be started'));
            this.waiting.clear();
        };
    }

    ask(what, question = {}, { transfer = [], onNews } = {}) {
        const id = this.next++;
        return new Promise((done, fail) => {
            this.waiting.set(id, { done, fail, onNews });
            this.worker.postMessage({ id, what, ...question }, transfer);
        });
    }
}

/** A mesh, made in a Worker that ends with it. */
export async function makeMesh(what, question, onNews) {
    const hand = new Hand(makerUrl);
    try {
        return await hand.ask(what, question, { onNews });
    } finally {
        hand.worker.terminate();
    }
}

const sum = (answers, name) => answers.reduce((total, answer) => total + answer[name], 0);

/** Each Worker has an index of its own. */
const joinVisits = (all) => ({
    nodes: all.flatMap(({ nodes }) => Array.from(nodes)),
    words: all.flatMap(({ words }) => Array.from(words)),
    roots: all.length,
    ofNodes: sum(all, 'ofNodes'),
    ofWords: sum(all, 'ofWords'),
});
const longest = (answers) => Math.max(...answers.map((answer) => answer.milliseconds));

export class Engine {
    /** Each Worker compiles and keeps the library for itself, and has its own part of the triangles: no memory is shared. */
    static async start(bytes, workers) {
        const engine = new Engine();
        const module = await WebAssembly.compile(bytes);
        engine.hands = Array.from({ length: workers }, () => new Hand(workerUrl));
        const [{ kernel }] = await Promise.all(engine.hands.map((hand) => hand.ask('open', { module })));
        engine.kernel = kernel;
        return engine;
    }

    get workers() {
        return this.hands.length;
    }

    /**
     * triangles: nine floats each. Parts are whole words of the masks. `parts` are those of the next question, `count` is that of
     * the mesh in use, which answers that are on their way are still about.
     */
    async load(triangles) {
        const count = triangles.length / 9, share = 64 * Math.ceil(count / 64 / this.workers);
        const starts = this.hands.map((_, w) => Math.min(w * share, count));
        const loads = this.hands.map((hand, w) => {
            const part = triangles.slice(9 * starts[w], 9 * Math.min((w + 1) * share, count));
            return hand.ask('load', { triangles: part }, { transfer: [part.buffer] });
        });
        this.parts = { starts, count };
        await Promise.all(loads);
        this.count = count;
    }

    all(what, question) {
        return Promise.all(this.hands.map((hand) => hand.ask(what, question)));
    }

    /** Which triangles overlap the box, lie inside, and are answered unlike EXACT. */
    async ask(question) {
        const { starts, count } = this.parts, answers = await this.all('ask', question);
        const join = (name) => joinBits(answers.map((answer) => answer[name]), starts, count);
        return {
            mask: join('mask'),
            inside: join('inside'),
            unlike: answers[0].unlike && join('unlike'),
            visits: answers[0].visits && joinVisits(answers.map((answer) => answer.visits)),
            overlapping: sum(answers, 'overlapping'),
            insides: sum(answers, 'insides'),
            undecided: sum(answers, 'undecided'),
            milliseconds: longest(answers),
        };
    }

    /** The time of a question that was asked, measured with care while nothing else is; null if something was. */
    async settle(question) {
        const answers = await this.all('settle', question);
        return answers.every((answer) => answer.milliseconds !== null) ? longest(answers) : null;
    }

    async voxelize(bounds, resolution, test) {
        const answers = await this.all('voxelize', { bounds, resolution, test });
        const { grid, bits } = answers[0];
        for (const answer of answers.slice(1)) setBits(bits, answer.bits);
        return { grid, bits, milliseconds: longest(answers) };
    }

    /** On one Worker, so on its part of the mesh. */
    measure(question, onNews) {
        return this.hands[0].ask('measure', question, { onNews });
    }
}

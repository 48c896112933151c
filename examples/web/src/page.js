// page.js - what is on the page, and what it does: shows a mesh, asks about the box, marks cells, measures.
import { boxOfPose, boxOfText, poseBox } from './box.js';
import { placesOf } from './mesh.js';
import { three, whole } from './numbers.js';

const WORDS = { paper: "the paper's", exact: 'tribox' };

function bar({ name, ns }, paper, most) {
    const word = document.createElement('dt'), value = document.createElement('dd'), length = document.createElement('i');
    const text = document.createElement('span'), number = document.createElement('b');
    word.textContent = WORDS[name];
    length.style.width = `calc((100% - 104px) * ${ns / most})`;
    number.textContent = three(ns);
    text.append(number, ' ns');
    if (name !== 'paper') text.append(`, ${(paper / ns).toFixed(1)}×`);
    value.append(length, text);
    value.className = name;
    return [word, value];
}

/** How many times as fast as the paper's. */
const factorOf = ({ rows }) => rows[0].ns / rows[1].ns;

function drawChart(to, { rows, rounds, triangles }, kernel) {
    const list = document.createElement('dl'), note = document.createElement('p');
    const [{ ns: paper }] = rows, most = Math.max(...rows.map((row) => row.ns));
    list.className = 'bars';
    list.append(...rows.flatMap((row) => bar(row, paper, most)));
    note.className = 'note';
    note.textContent =
        `Nanoseconds a triangle for this box: ${whole(triangles)} triangles on one thread, the least of ${rounds} rounds. ` +
        `The paper's algorithm is in the same WebAssembly as tribox's ${kernel}.`;
    to.replaceChildren(list, note);
}

/** Returns a function that asks for `work`. onError is handed what went wrong, or null when nothing did. */
function latest(work, onError) {
    let isBusy = false, isWanted = false;
    return async () => {
        isWanted = true;
        if (isBusy) return;
        isBusy = true;
        try {
            while (isWanted) {
                isWanted = false;
                await work();
            }
            onError(null);
        } catch (error) {
            onError(error);
        } finally {
            isBusy = false;
        }
    };
}

const BOX = 1, ALL = 7;

/** The test that is asked, and a note where it is not the one that was chosen. */
function allowedTest(test, box, byIndex) {
    if (box.turned && test.axes !== ALL && test.axes !== BOX)
        return {
            test: { ...test, axes: ALL },
            note: 'A turned box needs all axes, or the 3 of the box alone: all are taken.',
        };
    if (byIndex && !(test.axes & BOX))
        return { test: { ...test, axes: test.axes | BOX }, note: 'The index needs the 3 axes of the box: they are taken, too.' };
    return { test, note: '' };
}

const REST_MS = 150;

/** A box for a mesh that comes without one: in its upper corner, to be seen cutting it. */
function boxFor({ lo, hi }) {
    const sides = lo.map((l, a) => hi[a] - l), half = Math.max(...sides) / 5 || 1;
    return { center: lo.map((l, a) => (l + hi[a]) / 2 + sides[a] / 5), half: [half, half, half] };
}

export class Page {
    /** view: the stage, and on it triangles, cells, box and nodes. */
    constructor(panel, engine, view) {
        Object.assign(this, { panel, engine, view });
        this.mesh = null; // name, triangles, up, box, and what maker.js adds
        this.typed = null; // a box as typed, until the pose changes
        const say = (about) => (error) => (error ? panel.say(about, error.message) : panel.clearMessage(about));
        this.ask = latest(() => this.mesh && this.answer(), say('ask'));
        this.reload = latest(() => this.mesh && this.loadAgain(), say('ask'));
        this.voxelize = latest(() => this.mesh && this.markCells(), say('cells'));
    }

    box() {
        return this.typed ?? boxOfPose(this.view.box.pose, this.mesh.frame);
    }

    halfLengths() {
        return this.view.box.pose.scale.toArray().map((h) => h * this.mesh.frame.scale);
    }

    async answer() {
        const { mesh, panel, view } = this, box = this.box(), byIndex = panel.isByIndex();
        const { test, note } = allowedTest(panel.test(), box, byIndex), question = { box, test, byIndex };
        const clearOld = panel.clearOld(), answer = await this.engine.ask(question);
        if (mesh !== this.mesh) return;
        clearOld();
        const isLit = this.isOne && mesh.triangles.length === 9; // in a figure it keeps its colour
        view.triangles.classify(isLit ? { ...answer, mask: answer.mask.map(() => 1) } : answer);
        view.nodes.show(answer.visits, mesh.frame);
        view.cells.colour(box.turned ? null : box, mesh.frame);
        view.triangles.mark(panel.showAnswer(answer, question, mesh, this.engine));
        panel.noteTest(note);
        this.onAnswer?.(answer, mesh);
        this.settle(question);
    }

    /** Once the box rests its time is measured again, as first calls run in code that browsers have compiled in a hurry. */
    settle(question) {
        clearTimeout(this.resting);
        this.resting = setTimeout(async () => {
            const milliseconds = await this.engine.settle(question).catch(() => null);
            if (milliseconds !== null) this.panel.showTime(milliseconds, question.byIndex, this.engine);
        }, REST_MS);
    }

    async markCells() {
        const { mesh, panel, view } = this, isWanted = panel.wantsCells();
        view.triangles.visible = !isWanted;
        if (!isWanted) {
            view.cells.hide();
            return panel.hideCells();
        }
        const resolution = panel.resolution();
        const asked = await this.voxelsAt(resolution);
        let shown = asked;
        while (shown.faces && !shown.at.length) shown = await this.voxelsAt(Math.floor(0.8 * shown.resolution));
        if (mesh !== this.mesh) return;
        view.cells.show(shown.grid, shown.at, mesh);
        panel.showCells({ ...asked, resolution, drawnAt: shown.resolution }, this.engine);
    }

    /** The cells of this mesh, and their faces. */
    async voxelsAt(resolution) {
        const test = { accuracy: this.panel.test().accuracy, axes: 7, order: 0 };
        const { grid, bits, milliseconds } = await this.engine.voxelize(this.mesh.bounds, resolution, test);
        return { resolution, grid, milliseconds, ...this.view.cells.facesOf(grid, bits) };
    }

    boxMoved() {
        this.typed = null;
        if (this.mesh) this.ask();
    }

    /** to: a centre and half lengths, or a box as it is asked. */
    placeBox(to) {
        this.typed = to.lo || to.turned ? to : null;
        poseBox(this.view.box.pose, this.mesh.frame, to);
        this.view.stage.draw();
        this.ask();
    }

    /** Throws if the text is not a box. */
    placeText(text) {
        const box = boxOfText(text);
        if (this.mesh) this.placeBox(box);
    }

    reset() {
        if (!this.mesh) return;
        this.view.stage.lookFrom(this.mesh.up);
        this.placeBox(this.mesh.box);
    }

    /** next: what maker.js returns, and a box or none. */
    async show(next) {
        this.isLoading = true;
        try {
            await this.engine.load(next.triangles);
        } finally {
            this.isLoading = false;
        }
        this.mesh = { ...next, box: next.box ?? boxFor(next.bounds) };
        this.view.triangles.show(next);
        this.view.box.show();
        this.panel.showMesh(this.mesh);
        this.reset();
        this.voxelize();
    }

    /** The triangles of the mesh have moved: as many, in the frame that they have. */
    reshape(triangles) {
        if (this.isLoading || !this.mesh) return;
        this.mesh.triangles = triangles;
        this.view.triangles.move(placesOf(triangles, this.mesh.frame));
        this.reload();
    }

    async loadAgain() {
        if (this.isLoading) return;
        await this.engine.load(this.mesh.triangles);
        await this.ask();
    }

    async measure() {
        const { panel, engine } = this;
        panel.measuring('warming up…');
        try {
            const box = this.box();
            if (box.turned) throw new Error('The paper takes upright boxes. Press Reset, or type one.');
            const result = await engine.measure({ box, axes: panel.test().axes }, ({ stage }) => panel.measuring(`${stage}…`));
            drawChart(panel.chart, result, engine.kernel);
            panel.showFactor(factorOf(result), box);
        } catch (error) {
            panel.chartNote(error.message);
        } finally {
            panel.measured();
        }
    }
}

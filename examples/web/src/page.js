// page.js - what is on the page, and what it does: shows a mesh, asks about the box, marks cells, measures.
import { allowedTest } from './allowed.js';
import { boxOfPose, boxOfText, poseBox } from './box.js';
import { drawChart } from './chart.js';
import { latest } from './latest.js';
import { boundsOf, frameOf } from './mesh.js';

const REST_MS = 150;

/** A box for a mesh that comes without one: in its upper corner, to be seen cutting it. */
function boxFor({ lo, hi }) {
    const sides = lo.map((l, a) => hi[a] - l),
        half = Math.max(...sides) / 5 || 1;
    return { center: lo.map((l, a) => (l + hi[a]) / 2 + sides[a] / 5), half: [half, half, half] };
}

export class Page {
    /** view: the stage, and on it triangles, cells and box. */
    constructor(panel, engine, view) {
        Object.assign(this, { panel, engine, view });
        this.mesh = null; // name, triangles, up, box, bounds, frame
        this.typed = null; // a box as typed, until the pose changes
        const say = (about) => (error) => (error ? panel.say(about, error.message) : panel.clearMessage(about));
        this.ask = latest(() => this.mesh && this.answer(), say('ask'));
        this.voxelize = latest(() => this.mesh && this.markCells(), say('cells'));
    }

    box() {
        return this.typed ?? boxOfPose(this.view.box.pose, this.mesh.frame);
    }

    async answer() {
        const { mesh, panel, view } = this,
            box = this.box(),
            byIndex = panel.isByIndex();
        const { test, note } = allowedTest(panel.test(), box, byIndex),
            question = { box, test, byIndex };
        const answer = await this.engine.ask(question);
        if (mesh !== this.mesh) return;
        view.triangles.classify(answer);
        view.triangles.mark(panel.showAnswer(answer, question, mesh, this.engine));
        panel.noteTest(note);
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
        const { mesh, panel, view } = this,
            isWanted = panel.wantsCells();
        view.triangles.mesh.visible = !isWanted;
        if (!isWanted) {
            view.cells.hide();
            return panel.hideCells();
        }
        const resolution = panel.resolution(),
            test = { accuracy: panel.test().accuracy, axes: 7, order: 0 };
        const { grid, bits, milliseconds } = await this.engine.voxelize(mesh.bounds, resolution, test);
        if (mesh !== this.mesh) return;
        panel.showCells({ ...view.cells.show(grid, bits, mesh), grid, resolution, milliseconds });
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

    /** Returns whether the text is a box. */
    placeText(text) {
        const box = boxOfText(text);
        if (box && this.mesh) this.placeBox(box);
        return Boolean(box);
    }

    reset() {
        if (!this.mesh) return;
        this.view.stage.lookFrom(this.mesh.up);
        this.placeBox(this.mesh.box);
    }

    async show(next) {
        const bounds = boundsOf(next.triangles);
        if (!(bounds.lo[0] <= bounds.hi[0])) {
            throw new Error(`${next.name}: none of its triangles has finite coordinates. Export it again.`);
        }
        await this.engine.load(next.triangles);
        this.mesh = { ...next, bounds, frame: frameOf(bounds), box: next.box ?? boxFor(bounds) };
        this.view.triangles.show(this.mesh.triangles, this.mesh.frame);
        this.panel.showMesh(this.mesh);
        this.reset();
        this.voxelize();
    }

    async measure() {
        const { panel, engine } = this;
        panel.measuring('warming up…');
        try {
            const box = this.box();
            if (box.turned) throw new Error('The paper takes upright boxes. Press Reset, or type one.');
            const result = await engine.measure({ box, axes: panel.test().axes }, ({ stage }) => panel.measuring(`${stage}…`));
            drawChart(panel.chart, result, engine.kernel);
        } catch (error) {
            panel.chartNote(error.message);
        } finally {
            panel.measured();
        }
    }
}

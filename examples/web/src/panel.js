// panel.js - what the page says and what is chosen in it: every element beside the stage.
import { listBits } from './bits.js';
import { textOfBox } from './box.js';
import { milliseconds, three, whole } from './numbers.js';
import { scenes } from './scenes/scenes.js';

/** Rows of buttons of which one is chosen, as a group of radio buttons: arrows move, one stop for Tab. */
export function makeChoice(group, onChoice) {
    const buttons = [...group.querySelectorAll('[role="radio"]')];
    const choose = (value, isByUser = false) => {
        for (const button of buttons) {
            const isChosen = button.value === value;
            button.setAttribute('aria-checked', isChosen);
            button.tabIndex = isChosen ? 0 : -1;
            if (isChosen && isByUser) button.focus();
        }
        onChoice(value);
    };
    group.addEventListener('click', (event) => {
        const button = event.target.closest('[role="radio"]');
        if (button) choose(button.value);
    });
    group.addEventListener('keydown', (event) => {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        const at = buttons.findIndex((button) => button.getAttribute('aria-checked') === 'true');
        choose(buttons[(at + step + buttons.length) % buttons.length].value, true);
    });
    return choose;
}

const GROUPS = [[1, 'box'], [2, 'plane'], [4, 'edges']];

const quote = (name) => (/^[\w.,+-]+$/.test(name) && !name.startsWith('-') ? name : `'./${name.replaceAll("'", "'\\''")}'`);

function commandOf(name, box, test) {
    const words = ['tribox overlap', name ? quote(name) : 'MESH'];
    words.push(`${box.turned ? '--oriented' : '--box'}=${textOfBox(box)}`);
    if (!box.turned) words.push('--inside');
    if (test.accuracy !== 'exact') words.push('--accuracy', test.accuracy);
    if (test.axes !== 7)
        words.push('--axes', GROUPS.filter(([bit]) => test.axes & bit).map(([, word]) => word).join(','));
    if (test.order) words.push('--order', test.order);
    return words.join(' ');
}

/** Lines end after words, in words that are longer than a line after commas, and never at a hyphen. */
function showCommand(code, command) {
    const spans = (text, after, fill) =>
        text.split(after).map((part) => {
            const span = document.createElement('span');
            span.append(...fill(part));
            return span;
        });
    code.replaceChildren(...spans(command, /(?<= )/, (word) => spans(word, /(?<=,)/, (number) => [number])));
}

const element = (id) => document.getElementById(id);
const MOST_LISTED = 2000;
const SPEAK_AFTER = 700;
const RUNS = 10;

const NOTES = {
    exact: 'The true answer for every finite float.',
    conservative: 'Never misses an overlap; may report a triangle that misses by less than rounding.',
    fast: 'Single precision: errs either way within rounding of contact. Here it is hardly faster than exact.',
};

/** Of a file in the list of meshes. */
const fileValue = (name) => `file:${name}`;

export class Panel {
    constructor() {
        this.messages = new Map();
        this.chart = element('chart');
        for (const [name, { title }] of Object.entries(scenes)) element('scene').add(new Option(title, name));
        this.accuracy = 'exact';
        this.runs = { times: [] };
        this.chooseAccuracy = makeChoice(element('accuracy'), (accuracy) => {
            this.accuracy = accuracy;
            this.testChanged();
        });
        for (const id of ['order', 'by-index']) element(id).addEventListener('change', () => this.testChanged());
        for (const box of this.axisBoxes()) box.addEventListener('change', () => this.axisChanged(box));
        element('cells').addEventListener('change', () => this.onCells());
        element('resolution').addEventListener('input', () => this.resolutionChanged());
        element('measure').addEventListener('click', () => this.onMeasure());
        element('scene').addEventListener('change', ({ target }) => target.value && this.onScene(target.value));
        element('open').addEventListener('click', () => element('file').click());
        element('file').addEventListener('change', ({ target }) => {
            const [file] = target.files;
            target.value = '';
            if (file) this.onFile(file);
        });
        element('numbers').addEventListener('change', ({ target }) => this.numbersChanged(target));
        this.showAccuracy();
    }

    axisBoxes() {
        return [...document.querySelectorAll('[name="axes"]')];
    }

    /** Some axis is always chosen. */
    axisChanged(box) {
        if (!this.axisBoxes().some((other) => other.checked)) box.checked = true;
        this.testChanged();
    }

    testChanged() {
        this.showAccuracy();
        this.onTest?.();
    }

    noteTest(text) {
        element('test-note').textContent = text;
        element('test-note').hidden = !text;
    }

    showAccuracy() {
        element('accuracy-note').textContent = NOTES[this.accuracy];
        element('unlike-row').hidden = this.accuracy === 'exact';
    }

    resolutionChanged() {
        this.showResolution(element('resolution').value);
        element('cells').checked = true;
        this.onCells();
    }

    showResolution(cells) {
        for (const id of ['resolution-value', 'cells-value']) element(id).value = cells;
    }

    setResolution(cells) {
        element('resolution').value = cells;
        this.resolutionChanged();
    }

    showNumbers(text) {
        element('numbers').value = text;
        this.clearMessage('numbers');
    }

    numbersChanged(input) {
        try {
            this.onNumbers(input.value);
            this.clearMessage('numbers');
        } catch (error) {
            input.setAttribute('aria-invalid', true);
            this.say('numbers', `"${input.value}" is not a box: ${error.message}`);
        }
    }

    test() {
        const axes = this.axisBoxes().reduce((sum, box) => sum + (box.checked ? Number(box.value) : 0), 0);
        return { accuracy: this.accuracy, axes, order: Number(element('order').value) };
    }

    /** What a step of the story asks. */
    choose({ accuracy = 'exact', byIndex = false, cells = false, resolution = 64 }) {
        for (const box of this.axisBoxes()) box.checked = true;
        element('order').value = '0';
        element('by-index').checked = byIndex;
        element('cells').checked = cells;
        for (const id of ['resolution', 'cells-slider']) element(id).value = resolution;
        this.showResolution(resolution);
        this.chooseAccuracy(accuracy);
        this.onCells();
    }

    isByIndex() {
        return element('by-index').checked;
    }

    wantsCells() {
        return element('cells').checked;
    }

    resolution() {
        return Number(element('resolution').value);
    }

    /** One message at a time is seen, the latest of those that still hold. */
    say(about, text) {
        this.messages.delete(about);
        this.messages.set(about, text);
        this.showMessage();
    }

    /** What was said before a question was asked holds no longer once that is answered. */
    clearOld() {
        const old = ['numbers', 'file'].filter((about) => this.messages.has(about)).map((about) => [about, this.messages.get(about)]);
        return () => old.forEach(([about, text]) => this.messages.get(about) === text && this.clearMessage(about));
    }

    clearMessage(about) {
        if (about === 'numbers') element('numbers').removeAttribute('aria-invalid');
        if (this.messages.delete(about)) this.showMessage();
    }

    showMessage() {
        const text = [...this.messages.values()].at(-1);
        element('message').textContent = text ?? '';
        element('message').hidden = !text;
        if (text) element('message').scrollIntoView({ block: 'nearest' });
    }

    busy(isBusy) {
        document.body.classList.toggle('is-busy', isBusy);
    }

    showScene(name) {
        element('scene').value = name;
    }

    showMesh({ name, triangles, sample, bounds }) {
        const count = triangles.length / 9,
            left = bounds.notFinite ? ` ${whole(bounds.notFinite)} have coordinates that are not finite and overlap nothing.` : '';
        const drawn = sample
            ? ` Drawn coarser: ${whole(sample.numbers.length)} triangles stand for ${whole(count)}. Triangles that straddle are all drawn.`
            : '';
        if (name) element('scene').value = fileValue(name);
        element('mesh-note').textContent = `${name ? `${name}: ${whole(count)} triangles.` : ''}${left}${drawn} ` +
            'Or drop a file: .stl, .obj, .ply, .off, .glb. It stays on this machine.';
        this.showFactor(0);
    }

    /** Files that were read are in the list of meshes, too. */
    addFile(name) {
        const list = element('scene');
        if (![...list.options].some(({ value }) => value === fileValue(name))) list.add(new Option(name, fileValue(name)));
    }

    /** text: empty for none. */
    progress(text) {
        element('progress').textContent = text;
        element('progress').hidden = !text;
    }

    /** How many times as fast as the paper's, about a box; 0 where that was not measured. */
    showFactor(factor, box) {
        this.factorBox = box && textOfBox(box);
        element('factor').textContent = factor ? `${factor.toFixed(factor < 10 ? 1 : 0)} × the paper’s` : '';
        this.dimFactor();
    }

    /** It is grey beside the answer about another box. */
    dimFactor() {
        const isOfAnother = this.factorBox !== this.answeredBox;
        element('factor').classList.toggle('is-of-another', isOfAnother);
        element('factor').title = `Both on one thread, timed for ${isOfAnother ? 'another' : 'this'} box`;
    }

    /** Returns the triangles that are answered unlike EXACT. */
    showAnswer(answer, { box, test, byIndex }, mesh, engine) {
        const { overlapping, insides, unlike } = answer, { count } = engine;
        this.answeredBox = textOfBox(box);
        this.showTime(answer.milliseconds, byIndex, engine);
        this.dimFactor();
        element('straddling').textContent = whole(overlapping - insides);
        element('inside').textContent = whole(insides);
        element('missed').textContent = whole(count - overlapping);
        if (document.activeElement !== element('numbers')) this.showNumbers(this.answeredBox);
        element('numbers-label').textContent = box.turned ? 'Centre, half lengths, three axes' : 'Lower and upper corner';
        showCommand(element('command'), commandOf(mesh.name, box, test));
        this.speak(
            `${whole(overlapping - insides)} triangles straddle the box, ${whole(insides)} lie inside, ` +
                `${whole(count - overlapping)} miss it.`,
        );
        return this.listUnlike(unlike, test.accuracy);
    }

    /** What the time and the counts are about: "box", or "cells". */
    tellAbout(what) {
        this.about = what;
        document.body.classList.toggle('is-about-cells', what === 'cells');
    }

    /** The least of the last runs of one kind; nothing until there are two. */
    leastOf(kind, time) {
        if (this.runs.kind !== kind) this.runs = { kind, times: [] };
        this.runs.times = [...this.runs.times, time].slice(-RUNS);
        return this.runs.times.length > 1 ? Math.min(...this.runs.times) : null;
    }

    showTime(milliseconds, byIndex, { workers, count, kernel }) {
        if (this.about === 'cells') return;
        const ms = this.leastOf([count, byIndex, ...Object.values(this.test())].join(), milliseconds);
        const rate = byIndex ? 'by the index, ' : ms && count > 1000 ? `${three((1e6 * ms) / count)} ns a triangle, ` : '';
        this.showFigures(ms, rate, { workers, kernel });
    }

    showFigures(ms, what, { workers, kernel }) {
        element('time').value = ms === null ? '…' : milliseconds(ms);
        element('rate').textContent = `${what}${kernel}${workers > 1 ? `, ${workers} threads` : ''}`;
    }

    listUnlike(unlike, accuracy) {
        element('unlike-list').hidden = !unlike;
        if (!unlike) return [];
        const numbers = listBits(unlike), more = numbers.length - MOST_LISTED;
        element('unlike').textContent = whole(numbers.length);
        element('unlike-title').textContent = numbers.length
            ? `${accuracy.toUpperCase()} differs from EXACT on ${whole(numbers.length)} triangle${numbers.length === 1 ? '' : 's'}`
            : `${accuracy.toUpperCase()} and EXACT agree here on every triangle`;
        element('unlike-numbers').textContent =
            numbers.slice(0, MOST_LISTED).join(' ') + (more > 0 ? ` and ${whole(more)} more` : '');
        element('unlike-numbers').hidden = !numbers.length;
        return numbers;
    }

    /** For those who cannot see the counts, once the box rests. */
    speak(text) {
        clearTimeout(this.speaking);
        this.speaking = setTimeout(() => (element('spoken').textContent = text), SPEAK_AFTER);
    }

    showCells({ count, grid, resolution, drawnAt, milliseconds: ms }, engine) {
        const coarser = drawnAt < resolution ? ` Drawn at ${drawnAt}: more faces would be slow here.` : '';
        element('cells-note').textContent = `${whole(count)} of ${grid.size.join(' × ')} cells in ${milliseconds(ms)}.${coarser}`;
        if (this.about === 'cells') this.showFigures(ms, `${whole(count)} of ${grid.size.join(' × ')} cells, `, engine);
    }

    hideCells() {
        element('cells-note').textContent = 'Every cell of a grid that a triangle overlaps.';
    }

    measuring(text) {
        element('measure').disabled = true;
        element('measure').textContent = text;
    }

    measured() {
        element('measure').disabled = false;
        element('measure').textContent = 'Measure';
    }

    chartNote(text) {
        const note = document.createElement('p');
        note.className = 'note';
        note.textContent = text;
        this.chart.replaceChildren(note);
    }
}

// story.js - the pictures that one scrolls or clicks through, and the console that they hide.
import { axesOf, nameOf } from './axes.js';
import { Lanes } from './lanes.js';
import { whole } from './numbers.js';

/**
 * Of each picture: which mesh, what is asked of it, and whether the box moves by itself. triangle: what the figure begins with, and
 * isFlat, whether that lies in the plane of the picture.
 */
export const steps = [
    { scene: 'some', moves: true, isMeasured: true },
    { scene: 'one', triangle: [1.875, 0.5, 0, 2, 1.75, 0, 0.625, 1.75, 0], isFlat: true },
    { scene: 'one', triangle: [-1.625, 0.875, 2, 0.25, -1.75, 1.875, -1.875, -1.875, -0.125] },
    { scene: 'one', triangle: [-1.875, -0.625, 0.25, -1.875, 0.125, 1.375, -0.5, 1.25, 2] },
    { scene: 'one', triangle: [-1.375, -0.625, -0.25, -1.375, 0.125, 0.875, 0, 1.25, 1.5] },
    { scene: 'eight', moves: true, hasLanes: true },
    { scene: 'million', moves: true, size: 0.4, test: { byIndex: true } },
    { scene: 'grazing', test: { accuracy: 'fast' } },
    { scene: 'some', moves: true, test: { cells: true, resolution: 32 } },
];

/* Axes as small bars: above the box, below the triangle, and between them the gap, lit. */
function bar(className) {
    const made = document.createElement('i');
    made.className = className;
    return made;
}

/** A button that shows its axis in the picture. */
function item({ letter, number, group }) {
    const [made, button, name, track] = ['li', 'button', 'var', 'span'].map((tag) => document.createElement(tag));
    name.append(nameOf({ letter, number }));
    track.append(bar('of-box'), bar('of-triangle'), bar('gap'));
    made.className = group;
    button.type = 'button';
    button.append(name, track);
    made.append(button);
    return made;
}

/** From and to are shares of the width. */
function put(element, from, to) {
    element.style.left = `${100 * from}%`;
    element.style.width = `${Math.max(0, 100 * (to - from))}%`;
}

/** Fills a list with the axes of its groups, as bars; returns what shows axes in it, and which of them the picture has. */
function makeAxesView(list, onChoice) {
    let items = null;
    return (axes, shown, isChosen) => {
        if (!items) {
            items = axes.map(item);
            items.forEach((li, i) => li.firstChild.addEventListener('click', () => onChoice(list, i)));
            list.append(...items);
        }
        axes.forEach(({ letter, number, lo, hi, r, gap }, i) => {
            const span = 1.15 * Math.max(r, Math.abs(lo), Math.abs(hi)) || 1, at = (x) => 0.5 + x / span / 2;
            const button = items[i].firstChild, [ofBox, ofTriangle, between] = button.lastChild.children;
            put(ofBox, at(-r), at(r));
            put(ofTriangle, at(lo), at(hi));
            put(between, lo > r ? at(r) : at(hi), lo > r ? at(lo) : at(-r));
            button.classList.toggle('is-apart', gap > 0);
            button.classList.toggle('is-shown', i === shown);
            button.setAttribute('aria-pressed', isChosen && i === shown);
            button.setAttribute('aria-label', `Axis ${letter}${number}: ${gap > 0 ? 'a gap' : 'no gap'}`);
        });
    };
}

/** How far apart the shadows are, in lengths; less than 0 if they overlap. */
const slackOf = ({ axis, lo, hi, r }) => Math.max(lo - r, -r - hi) / Math.hypot(...axis) || -Infinity;

const element = (id) => document.getElementById(id);

export class Story {
    /** motion: null if boxes stay where they are. */
    constructor(page, panel, motion) {
        Object.assign(this, { page, panel, motion, isOpen: true, at: -1, scene: null });
        this.scroller = element('steps');
        this.articles = [...this.scroller.children];
        this.dots = [...element('dots').querySelectorAll('button')];
        this.lanes = new Lanes(element('lanes'));
        this.axes = this.articles.map((article) => {
            const list = article.querySelector('.axes');
            return list && { groups: list.dataset.groups.split(' '), show: makeAxesView(list, (_, i) => this.choose(i)) };
        });
        this.dots.forEach((dot, i) => dot.addEventListener('click', () => this.go(i)));
        for (const [id, by] of [['back', -1], ['next', 1]])
            element(id).addEventListener('click', () => this.go(this.at + by));
        element('console').addEventListener('click', () => (this.isOpen ? this.close() : this.open(this.at)));
        this.scroller.addEventListener('scroll', () => this.scrolled(), { passive: true });
        page.onAnswer = (answer, mesh) => this.answered(answer, mesh);
        this.listen();
    }

    /** The controls beside the sentences. */
    listen() {
        for (const slider of document.querySelectorAll('.box-size'))
            slider.addEventListener('input', () => {
                this.motion?.stop();
                this.size(Number(slider.value));
            });
        element('cells-slider').addEventListener('input', ({ target }) => this.panel.setResolution(target.value));
        for (const choice of document.getElementsByName('rounding'))
            choice.addEventListener('change', () => this.panel.chooseAccuracy(choice.value));
    }

    /** Makes the box a factor times as large as the scene's first one, where it is. */
    size(factor) {
        const { page } = this, { pose } = page.view.box;
        if (!page.mesh) return;
        pose.scale.fromArray(page.mesh.box.half.map((h) => (factor * h) / page.mesh.frame.scale));
        page.view.stage.draw();
        page.boxMoved();
    }

    get step() {
        return steps[this.at];
    }

    go(i) {
        const to = Math.min(steps.length - 1, Math.max(0, i));
        this.scroller.scrollTo({ top: this.articles[to].offsetTop, behavior: 'instant' });
        this.enter(to);
    }

    scrolled() {
        const { scrollTop, clientHeight } = this.scroller, middle = scrollTop + clientHeight / 2;
        const i = this.articles.findLastIndex((article) => article.offsetTop <= middle);
        if (this.isOpen) this.enter(Math.max(0, i));
    }

    async open(i) {
        this.isOpen = true;
        document.body.classList.remove('has-console');
        element('console').setAttribute('aria-pressed', false);
        this.at = -1;
        this.scene = null;
        this.go(i);
        await this.entering;
    }

    /** Opens the console: nothing moves by itself. */
    close() {
        this.isOpen = false;
        document.body.classList.remove('is-waiting');
        this.panel.tellAbout('box');
        this.motion?.stop();
        this.showFigure(null);
        document.body.classList.add('has-console');
        element('console').setAttribute('aria-pressed', true);
    }

    enter(i) {
        if (i === this.at) return;
        this.at = i;
        this.dots.forEach((dot, d) => dot.setAttribute('aria-current', d === i ? 'step' : 'false'));
        element('back').disabled = i === 0;
        element('next').disabled = i === steps.length - 1;
        this.entering = this.showStep(this.step);
    }

    async showStep(step) {
        const { page, panel, motion } = this, sliders = [...document.querySelectorAll('.box-size')];
        const article = this.articles[this.at], isNew = this.scene !== step.scene;
        motion?.stop();
        for (const slider of sliders) slider.value = step.size ?? 1;
        panel.tellAbout(step.test?.cells ? 'cells' : 'box');
        panel.choose(step.test ?? {});
        this.showFigure(null);
        this.scene = step.scene;
        this.isWaiting = isNew;
        for (const dimmed of [document.body, article]) dimmed.classList.toggle('is-waiting', isNew);
        if (isNew) {
            element('visits').textContent = '';
            this.loading = panel.onScene(step.scene);
        }
        await this.loading; // which an earlier step with the same mesh may have begun
        article.classList.remove('is-waiting');
        if (!this.isOpen || step !== this.step) return;
        this.isWaiting = false;
        document.body.classList.remove('is-waiting');
        if (!isNew) page.reset();
        if (step.size) this.size(Number(sliders[0].value));
        this.showFigure(step);
        if (step.moves) motion?.runUntilTouched();
        if (step.isMeasured) await page.measure();
    }

    /** What is drawn over the stage; step: null for nothing. */
    showFigure(step) {
        const { view, mesh } = this.page, hasFigure = Boolean(step?.triangle);
        document.body.classList.toggle('has-figure', hasFigure);
        document.body.classList.toggle('has-lanes', Boolean(step?.hasLanes));
        view.box.turnOn(!hasFigure, !step?.hasLanes);
        this.chosen = null;
        this.page.isOne = hasFigure;
        if (hasFigure) {
            mesh.triangles = Float32Array.from(step.triangle);
            view.stage.lookFrom(step.isFlat ? 'front' : 'z', step.isFlat ? 4.5 : 5.4);
        }
        const shown = hasFigure || step?.hasLanes ? mesh : null;
        view.figure.show(shown, { isFlat: step?.isFlat, box: step?.hasLanes ? () => this.page.box() : undefined });
        if (hasFigure) this.reshape(mesh.triangles);
    }

    /** Makes the picture as it was first. */
    restart() {
        if (this.isOpen && this.step.triangle) this.showFigure(this.step);
    }

    /** Changes the one triangle. */
    reshape(triangle) {
        this.look(triangle);
        this.page.reshape(triangle);
    }

    /** An axis of the list is shown until it is pressed again, or else the one that shows most. */
    choose(i) {
        this.chosen = this.chosen === i ? null : i;
        this.look(this.page.mesh.triangles);
        this.tell();
    }

    look(triangle) {
        const { figure } = this.page.view, list = this.axes[this.at];
        if (!list) return figure.turn(figure.angle);
        const all = axesOf(triangle).filter(({ group }) => list.groups.includes(group)), slacks = all.map(slackOf);
        const shown = this.chosen ?? slacks.indexOf(Math.max(...slacks));
        this.gaps = all.filter(({ gap }) => gap > 0);
        list.show(all, shown, this.chosen !== null);
        figure.look(all[shown]);
    }

    /** What the library says, and how the figure shows it. */
    tell() {
        const { overlapping, gaps, step } = this;
        if (!step?.triangle || overlapping === undefined) return;
        const say = (text) => (this.articles[this.at].querySelector('.verdict').textContent = text);
        if (overlapping) return say('They overlap: no axis shows a gap.');
        if (step.isFlat)
            return say(this.page.view.figure.shown.gap ? 'A gap: they are apart.' : 'No gap on this axis, but they are apart: turn it.');
        const [only] = gaps, show = gaps.length === 1 ? `${nameOf(only)} alone shows a gap` : `${gaps.length} axes show a gap`;
        say(`They are apart${gaps.length ? `: ${show}.` : ', but none of these axes shows it.'}`);
    }

    async answered({ overlapping, visits, unlike }) {
        if (!this.isOpen || this.isWaiting) return;
        this.overlapping = overlapping;
        this.tell();
        if (this.step?.hasLanes) {
            const left = await this.lanes.show(this.page.engine, this.page.box());
            if (left !== null)
                element('lanes-left').textContent = left
                    ? `${left} of the eight overlap${left === 1 ? 's' : ''} the box.`
                    : 'All eight are apart: the remaining tests are skipped.';
        }
        if (visits) {
            const looked = visits.roots + visits.nodes.length / 6;
            element('visits').textContent = `${whole(looked)} of ${whole(visits.ofNodes)} nodes looked at, ` +
                `${whole(visits.words.length / 6)} of ${whole(visits.ofWords)} groups of 64 triangles tested.`;
        }
        if (this.step?.scene === 'grazing') {
            const wrong = unlike ? Number(element('unlike').textContent) : 0;
            element('ties-count').textContent = unlike ? `${wrong} of 30 are wrong, shown in pink.` : 'All 30 are right.';
        }
    }
}

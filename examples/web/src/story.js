// story.js - the pictures that one scrolls or clicks through, and the console that they hide.
import { whole } from './numbers.js';

/** Of each picture: which mesh, what is asked of it, and whether the box moves by itself. */
export const steps = [
    { scene: 'some', moves: true, isMeasured: true },
    { scene: 'one', hasCorners: true },
    { scene: 'some', moves: true },
    { scene: 'million', moves: true, size: 0.4, test: { byIndex: true } },
    { scene: 'grazing', test: { accuracy: 'fast' } },
    { scene: 'some', moves: true, test: { cells: true, resolution: 32 } },
];

/* The thirteen axes of the paper about one triangle and the cube from -1 to 1: where each sees both, and the gap between. */
const UNIT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

const cross = (u, v) => [0, 1, 2].map((a) => u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3]);
const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];

/** The paper's letters: e for normals of the box, n for that of the triangle, a for the cross product of a normal and an edge. */
function directions(vertices) {
    const edges = [0, 1, 2].map((j) => vertices[(j + 1) % 3].map((x, a) => x - vertices[j][a]));
    return [
        ...UNIT.map((e, i) => ({ letter: 'e', number: `${i}`, group: 'box', axis: e })),
        { letter: 'n', number: '', group: 'plane', axis: cross(edges[0], edges[1]) },
        ...UNIT.flatMap((e, i) => edges.map((f, j) => ({ letter: 'a', number: `${i}${j}`, group: 'edges', axis: cross(e, f) }))),
    ];
}

/**
 * The interval of the triangle on each axis, lo to hi; that of the cube is -r to r. gap: what lies between, 0 where they touch or
 * overlap. Exact for multiples of 1/64 below 8, as all products then fit a double.
 */
export function axesOf(triangle) {
    const vertices = [0, 3, 6].map((at) => Array.from(triangle.slice(at, at + 3)));
    return directions(vertices).map(({ axis, ...name }) => {
        const places = vertices.map((v) => dot(axis, v)), r = Math.abs(axis[0]) + Math.abs(axis[1]) + Math.abs(axis[2]);
        const lo = Math.min(...places), hi = Math.max(...places);
        return { ...name, lo, hi, r, gap: Math.max(lo - r, -r - hi, 0) };
    });
}

/* The thirteen axes as small bars: above the box, below the triangle, and lit what lies between them. */
function bar(className) {
    const made = document.createElement('i');
    made.className = className;
    return made;
}

function item({ letter, number, group }) {
    const made = document.createElement('li'), name = document.createElement('var');
    name.append(letter);
    if (number) name.append(Object.assign(document.createElement('sub'), { textContent: number }));
    const track = document.createElement('span');
    track.append(bar('of-box'), bar('of-triangle'), bar('gap'));
    made.className = group;
    made.append(name, track);
    return made;
}

/** From and to are shares of the width. */
function put(element, from, to) {
    element.style.left = `${100 * from}%`;
    element.style.width = `${Math.max(0, 100 * (to - from))}%`;
}

/** Fills a list with bars; returns what shows the axes in it. */
function makeAxesView(list) {
    let items = null;
    return (axes) => {
        items ??= axes.map(item);
        if (!list.children.length) list.append(...items);
        axes.forEach(({ letter, number, lo, hi, r, gap }, i) => {
            const span = 1.15 * Math.max(r, Math.abs(lo), Math.abs(hi)) || 1, at = (x) => 0.5 + x / span / 2;
            const [ofBox, ofTriangle, between] = items[i].lastChild.children;
            put(ofBox, at(-r), at(r));
            put(ofTriangle, at(lo), at(hi));
            put(between, lo > r ? at(r) : at(hi), lo > r ? at(lo) : at(-r));
            items[i].classList.toggle('is-apart', gap > 0);
            items[i].setAttribute('aria-label', `${letter}${number}: ${gap > 0 ? 'a gap' : 'no gap'}`);
        });
    };
}

const element = (id) => document.getElementById(id);

export class Story {
    /** motion: null where boxes are to stay where they are. */
    constructor(page, panel, motion) {
        Object.assign(this, { page, panel, motion, isOpen: true, at: -1, scene: null });
        this.scroller = element('steps');
        this.articles = [...this.scroller.children];
        this.dots = [...element('dots').querySelectorAll('button')];
        this.showAxes = makeAxesView(element('axes'));
        this.dots.forEach((dot, i) => dot.addEventListener('click', () => this.go(i)));
        for (const [id, by] of [['back', -1], ['next', 1]])
            element(id).addEventListener('click', () => this.go(this.at + by));
        element('console').addEventListener('click', () => (this.isOpen ? this.close() : this.open(this.at)));
        this.scroller.addEventListener('scroll', () => this.scrolled(), { passive: true });
        page.onAnswer = (answer, mesh) => this.answered(answer, mesh);
        this.listen();
    }

    /** What is beside the sentences. */
    listen() {
        for (const slider of document.querySelectorAll('.box-size'))
            slider.addEventListener('input', () => {
                this.motion?.stop();
                this.size(Number(slider.value));
            });
        element('slide').addEventListener('input', ({ target }) => this.page.view.corners.slide(Number(target.value)));
        element('cells-slider').addEventListener('input', ({ target }) => this.panel.setResolution(target.value));
        for (const choice of document.getElementsByName('rounding'))
            choice.addEventListener('change', () => this.panel.chooseAccuracy(choice.value));
    }

    /** Of the box that the scene begins with, times a factor, where it is. */
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

    /** To the console: nothing moves that is not moved by hand. */
    close() {
        this.isOpen = false;
        this.motion?.stop();
        this.page.view.corners.show(null);
        this.page.view.box.turnOn(true);
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
        const { page, panel, motion } = this, { view } = page;
        motion?.stop();
        panel.choose(step.test ?? {});
        if (this.scene !== step.scene) {
            this.scene = step.scene;
            view.corners.show(null);
            await panel.onScene(step.scene);
        } else page.reset();
        if (!this.isOpen || step !== this.step) return;
        for (const slider of document.querySelectorAll('.box-size')) slider.value = step.size ?? 1;
        if (step.size) this.size(step.size);
        view.box.turnOn(!step.hasCorners);
        view.corners.show(step.hasCorners ? page.mesh : null);
        if (step.hasCorners) this.reshape(page.mesh.triangles);
        if (step.moves) motion?.runUntilTouched();
        if (step.isMeasured) await page.measure();
    }

    /** Of the one triangle. */
    reshape(triangle) {
        this.showAxes(axesOf(triangle));
        this.page.reshape(triangle);
    }

    answered({ overlapping, visits, unlike }, mesh) {
        if (!this.isOpen) return;
        if (this.step?.hasCorners) {
            const apart = axesOf(mesh.triangles).filter(({ gap }) => gap > 0).length;
            element('verdict').textContent = overlapping
                ? 'They overlap: no axis shows a gap.'
                : `They are apart: ${apart === 1 ? 'one axis shows' : `${apart} axes show`} a gap.`;
        }
        if (visits) {
            const looked = visits.roots + visits.nodes.length / 6;
            element('visits').textContent = `${whole(looked)} of ${whole(visits.ofNodes)} nodes looked at, ` +
                `${whole(visits.words.length / 6)} of ${whole(visits.ofWords)} groups of 64 triangles tested.`;
        }
        if (this.step?.scene === 'grazing') {
            const wrong = unlike ? Number(element('unlike').textContent) : 0;
            element('ties-count').textContent = unlike ? `${wrong} of 30 are wrong: the pink ones.` : 'All 30 are right.';
        }
    }
}

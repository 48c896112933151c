// figure.js - over the stage: triangles to be dragged, and one axis with the shadows on it, the gap between, and a plane in the gap.
import { Color, DoubleSide, Matrix4, Mesh, MeshBasicMaterial, PlaneGeometry, Vector3 } from 'three';
import { cross, dot, nameOf, shadowsOf, verticesOf } from '../axes.js';
import { ARROWS, axesSeen } from './box_keys.js';
import { EDGES } from './node_boxes.js';

const GRID = 64, // to a unit of the mesh, so that numbers are short
    REACH = 3, STEP = 1 / 16, TURN = Math.PI / 60,
    FLAT = { away: 1.9, end: 2.6 }, // of the axis in the plane: from the middle, and how long
    CUBE = { lo: [-1, -1, -1], hi: [1, 1, 1] }, SQUARE = { lo: [-1, -1, 0], hi: [1, 1, 0] },
    SPREAD = 1.5; // half a side of the plane in the gap

const snapped = (x) => Math.min(REACH, Math.max(-REACH, Math.round(GRID * x) / GRID));
const plus = (u, t, v) => u.map((x, a) => x + t * v[a]);
const unit = (u) => u.map((x) => x / Math.hypot(...u));

function make(parent, name, attributes = {}, text = '') {
    const made = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = text;
    parent.append(made);
    return made;
}

export class Figure {
    /** onMove is handed the nine numbers of the triangle; onTurn, nothing: the axis of the plane has turned. */
    constructor(stage, svg, onMove, onTurn) {
        Object.assign(this, { stage, svg, onMove, onTurn, mesh: null, angle: 0 });
        this.plane = new Mesh(
            new PlaneGeometry(2 * SPREAD, 2 * SPREAD),
            new MeshBasicMaterial({ transparent: true, opacity: 0.22, side: DoubleSide, depthWrite: false, toneMapped: false }),
        );
        stage.scene.add(this.plane);
        stage.beforeDraw.push(() => this.draw());
        this.show(null);
    }

    /** mesh: of one triangle that can be dragged, or some that are numbered; null for none. box: where it is, or none for the cube. */
    show(mesh, { isFlat = false, box = () => (isFlat ? SQUARE : CUBE) } = {}) {
        Object.assign(this, { mesh, isFlat, box, shown: null });
        this.svg.replaceChildren();
        this.svg.classList.toggle('is-flat', isFlat);
        document.body.classList.toggle('is-flat', isFlat);
        this.plane.visible = false;
        if (mesh) this.build(mesh.triangles);
        this.stage.draw();
    }

    build(triangles) {
        const { svg } = this, isOne = triangles.length === 9;
        const draw = (name, className, more) => make(svg, name, { class: className, ...more });
        this.triangles = Array.from({ length: triangles.length / 9 }, (_, i) => verticesOf(triangles.subarray(9 * i)));
        this.boxLines = draw('path', 'solid of-box');
        this.bodies = this.triangles.map(() => draw('polygon', 'solid body'));
        if (!isOne) {
            this.numbers = this.triangles.map((_, i) => make(svg, 'text', { class: 'lane-number' }, `${i + 1}`));
            return;
        }
        for (const name of ['parting', 'touching', 'light', 'axis', 'of-box', 'of-triangle', 'gap']) this[name] = draw('path', name);
        const [vertices] = this.triangles;
        this.hold(this.bodies[0], 'Triangle', () => vertices[0], (to) => {
            const by = to.map((x, a) => x - vertices[0][a]);
            if (vertices.every((v) => v.every((x, a) => Math.abs(x + by[a]) <= REACH))) this.move([0, 1, 2], by);
        });
        this.knobs = vertices.map((_, v) => {
            const to = (place) => this.move([v], place.map((x, a) => x - vertices[v][a]));
            return this.hold(this.knob(), `Corner ${v + 1}`, () => vertices[v], to);
        });
        this.labels = ['box', 'triangle', 'gap', 'name'].map((name) => make(svg, 'text', { class: `label ${name}` }, name));
        this.tellPlaces();
        if (!this.isFlat) return;
        const turned = ([x, y]) => this.turn(Math.atan2(y, x) + Math.atan2(FLAT.away, FLAT.end));
        this.handle = this.hold(this.knob('turns'), 'Axis', () => this.placeOf(FLAT.end), turned, (arrow) =>
            this.turn(this.angle + TURN * arrow[1] * (arrow[0] === 'right' ? -1 : 1)),
        );
        this.turn(this.angle);
    }

    knob(more = '') {
        const knob = make(this.svg, 'g', { class: `knob ${more}` });
        make(knob, 'circle', { r: 22, class: 'grip' });
        make(knob, 'circle', { r: 7 });
        return knob;
    }

    /** Of an element to be dragged: at, its place; move, handed where it is to be; key, handed an arrow if not as by hand. */
    hold(element, name, at, move, key = ([way, sign]) => move(plus(at(), sign * STEP, axesSeen(this.stage.camera)[way].toArray()))) {
        let held = null, from = null;
        for (const [a, value] of Object.entries({ tabindex: 0, role: 'button', 'aria-roledescription': 'handle', 'aria-label': name }))
            element.setAttribute(a, value);
        element.addEventListener('pointerdown', (event) => {
            if (event.button !== 0) return;
            element.setPointerCapture(event.pointerId);
            [held, from] = [at(), this.under(event, at())];
        });
        element.addEventListener('pointermove', (event) => {
            if (element.hasPointerCapture(event.pointerId)) move(plus(plus(held, 1, this.under(event, held)), -1, from));
        });
        element.addEventListener('keydown', (event) => {
            const arrow = ARROWS[event.key];
            if (!arrow || event.ctrlKey || event.metaKey || (this.isFlat && arrow[0] === 'away')) return;
            event.preventDefault();
            key(arrow);
        });
        return element;
    }

    /** Some corners of the one triangle, by so much. */
    move(corners, by) {
        const [vertices] = this.triangles;
        for (const v of corners) vertices[v] = vertices[v].map((x, a) => snapped(x + by[a]));
        this.tellPlaces();
        this.onMove(Float32Array.from(vertices.flat()));
    }

    /** For those who cannot see them. */
    tellPlaces() {
        this.knobs.forEach((knob, v) => knob.setAttribute('aria-label', `Corner ${v + 1} at ${this.triangles[0][v].join(', ')}`));
    }

    turn(angle) {
        this.angle = angle;
        this.look(shadowsOf([Math.cos(angle), Math.sin(angle), 0], this.triangles[0]));
        this.onTurn();
    }

    /** An axis of axes.js, and its shadows. */
    look(axis) {
        const size = Math.hypot(...axis.axis) || 1;
        const [lo, hi, r, gap] = [axis.lo, axis.hi, axis.r, axis.gap].map((x) => x / size);
        this.shown = { ...axis, lo, hi, r, gap: gap > 1e-9 ? gap : 0, axis: axis.axis.map((x) => x / size) };
        this.stage.draw();
    }

    /** Where the stage has a place of the mesh, in pixels. */
    pixel(place) {
        const { camera, canvas } = this.stage, { middle, scale } = this.mesh.frame;
        const { x, y } = new Vector3(...place.map((c, a) => (c - middle[a]) / scale)).project(camera);
        return [(0.5 + x / 2) * canvas.clientWidth, (0.5 - y / 2) * canvas.clientHeight].map((p) => Math.round(10 * p) / 10);
    }

    /** What is under the pointer, as far away as a place is. */
    under({ clientX, clientY }, place) {
        const { camera, canvas } = this.stage, { middle, scale } = this.mesh.frame, box = canvas.getBoundingClientRect();
        const there = new Vector3(...place.map((c, a) => (c - middle[a]) / scale)).project(camera);
        there.x = (2 * (clientX - box.left)) / box.width - 1;
        there.y = 1 - (2 * (clientY - box.top)) / box.height;
        return there.unproject(camera).toArray().map((x, a) => middle[a] + scale * x);
    }

    /** A path through places: one line, or more. */
    line(element, ...lines) {
        element.setAttribute('d', lines.map((places) => `M${places.map((p) => this.pixel(p).join()).join('L')}`).join(''));
    }

    /** towards: where a text has room. */
    put(element, place, towards) {
        let [x, y] = this.pixel(place);
        if (towards) {
            const [u, v] = unit(plus(this.pixel(towards), -1, [x, y]));
            [x, y] = [x + (16 + element.textContent.length * 3.5) * u, y + 22 * v];
        }
        if (element.localName === 'text') for (const [name, value] of [['x', x], ['y', y]]) element.setAttribute(name, value);
        else element.setAttribute('transform', `translate(${x} ${y})`);
    }

    /** Away from the middle, at a right angle to the axis, and so that the axis lies below all else: by how much. */
    aside() {
        const { axis } = this.shown, [vertices] = this.triangles;
        if (this.isFlat) return { down: [axis[1], -axis[0], 0], away: FLAT.away, end: FLAT.end };
        const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
        this.stage.camera.matrixWorld.extractBasis(right, up, back);
        const side = new Vector3(...axis).cross(back);
        if (side.lengthSq() < 1e-6) side.copy(right);
        side.normalize();
        if (side.dot(up) > 0.4 * side.dot(right)) side.negate();
        const down = side.toArray(), { lo, hi, r } = this.shown;
        const below = Math.max(...vertices.map((v) => dot(v, down)), down.reduce((sum, x) => sum + Math.abs(x), 0));
        return { down, away: Math.min(REACH, below + 0.4), end: Math.max(r, -lo, hi) + 0.4 };
    }

    /** On the axis, as far along it and below it. */
    placeOf(along, below = 0) {
        const { down, away } = this.aside();
        return plus(plus([0, 0, 0], along, this.shown.axis), away + below, down);
    }

    draw() {
        if (!this.mesh) return;
        const { triangles } = this, { lo, hi } = this.box();
        const corners = EDGES.map((corner) => corner.map((high, a) => (high ? hi[a] : lo[a])));
        this.line(this.boxLines, ...Array.from({ length: 12 }, (_, e) => [corners[2 * e], corners[2 * e + 1]]));
        triangles.forEach((t, i) => this.bodies[i].setAttribute('points', t.map((v) => this.pixel(v).join()).join(' ')));
        if (triangles.length > 1)
            triangles.forEach((t, i) => this.put(this.numbers[i], [0, 1, 2].map((a) => (t[0][a] + t[1][a] + t[2][a]) / 3)));
        else if (this.shown) this.drawAxis(triangles[0]);
    }

    drawAxis(vertices) {
        const { axis, lo, hi, r, gap, letter = 'turn', number = '' } = this.shown, { down, away, end } = this.aside();
        const at = (along, below = 0) => plus(plus([0, 0, 0], along, axis), away + below, down);
        const corner = (sign) => axis.map((x, a) => Math.sign(Math.abs(x) > 1e-9 ? sign * x : this.isFlat && a === 2 ? 0 : down[a]));
        const nearest = (place) => vertices.toSorted((u, v) => Math.abs(dot(u, axis) - place) - Math.abs(dot(v, axis) - place))[0];
        this.line(this.light, ...[-1, 1].map((s) => [corner(s), at(s * r)]), ...[lo, hi].map((x) => [nearest(x), at(x)]));
        this.line(this.axis, [at(-end), at(end)]);
        this.line(this['of-box'], [at(-r, -0.07), at(r, -0.07)]);
        this.line(this['of-triangle'], [at(lo, 0.07), at(hi, 0.07)]);
        const from = lo > r ? r : hi, to = lo > r ? lo : -r, middle = (from + to) / 2;
        this.svg.classList.toggle('is-apart', gap > 0);
        this.line(this.gap, [at(from), at(to)]);
        this.labels[3].textContent = nameOf({ letter, number });
        const beside = [[0, at(0), -1], [1, at((lo + hi) / 2), 1], [2, at(middle), -1]];
        for (const [label, place, side] of beside) this.put(this.labels[label], place, plus(place, side, down));
        this.put(this.labels[3], at(end), at(end + 1));
        this.knobs.forEach((knob, v) => this.put(knob, vertices[v]));
        if (this.isFlat) this.put(this.handle, at(end));
        this.drawPlane(middle, gap, vertices);
        this.line(this.touching, ...this.touched(lo > r ? 1 : -1));
    }

    /** Through the middle of the gap. */
    drawPlane(middle, gap, vertices) {
        const { axis } = this.shown;
        if (this.isFlat) {
            const { down, away } = this.aside();
            return this.line(this.parting, [-REACH, away].map((below) => plus(plus([0, 0, 0], middle, axis), below, down)));
        }
        const between = [0, 1, 2].map((a) => (vertices[0][a] + vertices[1][a] + vertices[2][a]) / 6);
        const center = plus(between, middle - dot(between, axis), axis), least = axis.map(Math.abs);
        const u = unit(cross(axis, [0, 1, 2].map((a) => Number(a === least.indexOf(Math.min(...least)))))), w = cross(axis, u);
        const { middle: origin, scale } = this.mesh.frame;
        this.plane.visible = gap > 0;
        this.plane.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(...[u, w, axis].map((v) => new Vector3(...v))));
        this.plane.position.fromArray(center.map((c, a) => (c - origin[a]) / scale));
        this.plane.scale.setScalar(1 / scale);
        const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];
        this.line(this.parting, corners.map(([s, t]) => plus(plus(center, s * SPREAD, u), t * SPREAD, w)));
    }

    /** What the axis is at right angles to, on the side of the gap: a face of the box, the triangle, or an edge of each. */
    touched(side) {
        const { axis, group, edges } = this.shown, [[p, q, s]] = this.triangles;
        if (group === 'plane') return [[p, q, s, p]];
        if (group === 'box') {
            const a = axis.findIndex((x) => x !== 0);
            const face = [[1, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]].map(([u, v]) => {
                const place = [0, 0, 0];
                [place[a], place[(a + 1) % 3], place[(a + 2) % 3]] = [side, u, v];
                return place;
            });
            return [face];
        }
        if (group !== 'edges') return [];
        const [i, j] = edges, ofBox = [-1, 1].map((end) => axis.map((x, a) => (a === i ? end : Math.sign(side * x) || 1)));
        return [ofBox, [this.triangles[0][j], this.triangles[0][(j + 1) % 3]]];
    }

    paint(colours) {
        this.plane.material.color = new Color(colours.unlike);
        this.stage.draw();
    }
}

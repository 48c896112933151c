// corners.js - the corners of one triangle, to be dragged or moved by keys: on a grid, so that its numbers are short.
import { Color, Mesh, MeshBasicMaterial, SphereGeometry } from 'three';
import { ARROWS, axesSeen } from './box_keys.js';
import { addDrag } from './drag.js';

const GRID = 64, // to a unit of the mesh
    REACH = 3, STEP = 1 / 16,
    GRIP = 0.16, // what a finger hits
    SEEN = 0.045;

const snapped = (x) => Math.min(REACH, Math.max(-REACH, Math.round(GRID * x) / GRID));

export class Corners {
    /** onMove is handed the nine numbers of the triangle. Made before the camera's own hold on the pointer. */
    constructor(stage, onMove) {
        Object.assign(this, { stage, onMove, isOn: false, chosen: 0 });
        this.knobs = [0, 1, 2].map(() => {
            const knob = new Mesh(new SphereGeometry(GRIP, 12, 8), new MeshBasicMaterial({ visible: false }));
            knob.add(new Mesh(new SphereGeometry(SEEN, 20, 14), new MeshBasicMaterial({ toneMapped: false, depthTest: false })));
            knob.children[0].renderOrder = 4;
            knob.visible = false;
            stage.scene.add(knob);
            return knob;
        });
        this.listen();
    }

    /** mesh: null for none to be moved. */
    show(mesh) {
        this.isOn = Boolean(mesh);
        for (const knob of this.knobs) knob.visible = this.isOn;
        if (mesh) {
            this.frame = mesh.frame;
            this.set(mesh.triangles);
        }
        this.stage.draw();
    }

    set(triangle) {
        const { middle, scale } = this.frame;
        this.triangle = Float32Array.from(triangle);
        this.knobs.forEach((knob, v) =>
            knob.position.fromArray([0, 1, 2].map((a) => (this.triangle[3 * v + a] - middle[a]) / scale)),
        );
    }

    put(v, place) {
        const { middle, scale } = this.frame;
        place.toArray().forEach((x, a) => (this.triangle[3 * v + a] = snapped(middle[a] + scale * x)));
        this.moved();
    }

    /** All of it, so that its middle is at x. */
    slide(x) {
        const middle = (this.triangle[0] + this.triangle[3] + this.triangle[6]) / 3;
        for (const at of [0, 3, 6]) this.triangle[at] = snapped(this.triangle[at] + x - middle);
        this.moved();
    }

    moved() {
        this.set(this.triangle);
        this.onMove(this.triangle.slice());
    }

    listen() {
        addDrag(this.stage, {
            grip: (ray) => {
                const [hit] = this.isOn ? ray.intersectObjects(this.knobs, false) : [];
                if (!hit) return null;
                this.chosen = this.knobs.indexOf(hit.object);
                this.stage.orbit.enabled = false;
                return hit.object.position;
            },
            move: (to) => this.put(this.chosen, to),
            letGo: () => (this.stage.orbit.enabled = true),
        });
        this.stage.canvas.addEventListener('keydown', (event) => this.isOn && this.takeKey(event));
    }

    takeKey(event) {
        if (event.ctrlKey || event.metaKey) return;
        const arrow = ARROWS[event.key];
        if (arrow) {
            const axis = axesSeen(this.stage.camera)[arrow[0]], place = this.knobs[this.chosen].position.clone();
            this.put(this.chosen, place.addScaledVector(axis, (arrow[1] * STEP) / this.frame.scale));
        } else if ('123'.includes(event.key)) this.chosen = Number(event.key) - 1;
        else return;
        event.preventDefault();
    }

    paint(colours) {
        for (const knob of this.knobs) knob.children[0].material.color = new Color(colours.box);
    }
}

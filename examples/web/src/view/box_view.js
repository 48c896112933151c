// box_view.js - the box on the stage: its faces and edges, the handles that move, turn and size it, and its body to be dragged.
import { BoxGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial, Object3D, Vector3 } from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { addDrag } from './drag.js';
import { EDGES } from './node_boxes.js';

const LEAST_HALF = 1e-4;

export class BoxView {
    /** onChange is called with every move by hand: the pose has changed. */
    constructor(stage, onChange) {
        this.stage = stage;
        this.onChange = onChange;
        this.isOn = true;
        this.pose = new Object3D(); // unit cube from -1 to 1, so that its scale is half the lengths
        this.faces = new Mesh(
            new BoxGeometry(2, 2, 2),
            new MeshBasicMaterial({ transparent: true, opacity: 0.07, depthWrite: false, side: DoubleSide, toneMapped: false }),
        );
        this.faces.renderOrder = 1;
        const lines = new LineSegmentsGeometry().setPositions(EDGES.flatMap((corner) => corner.map((high) => 2 * high - 1)));
        this.edges = new LineSegments2(lines, new LineMaterial({ linewidth: 2.25, toneMapped: false }));
        this.hidden = new LineSegments2(
            lines,
            new LineMaterial({ linewidth: 1.25, transparent: true, opacity: 0.35, depthTest: false, toneMapped: false }),
        );
        this.edges.renderOrder = this.hidden.renderOrder = 2;
        this.pose.add(this.faces, this.edges, this.hidden);
        this.pose.visible = false;
        stage.scene.add(this.pose);
        this.addHandles();
        this.handles.getHelper().visible = false;
        this.addDragging();
        stage.afterResize.push((width, height) => {
            for (const line of [this.edges, this.hidden]) line.material.resolution.set(width, height);
        });
    }

    addHandles() {
        this.handles = new TransformControls(this.stage.camera, this.stage.canvas);
        this.handles.attach(this.pose);
        this.handles.setColors('#f0616d', '#5fc27e', '#5b8def', '#ffd34d');
        this.handles.setSize(matchMedia('(pointer: coarse)').matches ? 1 : 0.75);
        this.handles.addEventListener('change', () => this.stage.draw());
        this.handles.addEventListener('dragging-changed', ({ value }) => (this.stage.orbit.enabled = !value));
        this.handles.addEventListener('objectChange', () => this.changed());
        this.stage.scene.add(this.handles.getHelper());
    }

    /** Once there is something that it is about. */
    show() {
        this.pose.visible = true;
        this.handles.getHelper().visible = this.isOn;
    }

    /** Whether it can be moved by hand, and turned. */
    turnOn(isOn, turns = true) {
        this.isOn = this.handles.enabled = isOn;
        this.turns = turns;
        this.handles.getHelper().visible = isOn && this.pose.visible;
        this.stage.draw();
    }

    /** "translate", "rotate" or "scale". */
    setMode(mode) {
        this.handles.setMode(mode);
        this.handles.setSpace(mode === 'translate' ? 'world' : 'local');
        this.stage.draw();
    }

    changed() {
        for (const axis of ['x', 'y', 'z']) this.pose.scale[axis] = Math.max(LEAST_HALF, Math.abs(this.pose.scale[axis]));
        this.stage.draw();
        this.onChange();
    }

    /** Its body. */
    addDragging() {
        const held = new Vector3();
        addDrag(this.stage, {
            grip: (ray) => {
                const isFree = this.isOn && !this.handles.dragging && !this.handles.axis;
                const [hit] = isFree ? ray.intersectObject(this.faces) : [];
                if (!hit) return null;
                held.copy(hit.point).sub(this.pose.position);
                this.stage.orbit.enabled = this.handles.enabled = false;
                return hit.point;
            },
            move: (to) => {
                this.pose.position.copy(to.sub(held));
                this.changed();
            },
            letGo: () => (this.stage.orbit.enabled = this.handles.enabled = true),
        });
    }

    paint(colours) {
        this.faces.material.color = new Color(colours.box);
        for (const line of [this.edges, this.hidden]) line.material.color = new Color(colours.box);
        this.stage.draw();
    }
}

// box_view.js - the box on the stage: its faces and edges, the handles that move, turn and size it, and its body to be dragged.
import { BoxGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial, Object3D, Plane, Raycaster, Vector2, Vector3 } from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

const EDGES = [0, 1, 2].flatMap((axis) =>
    [[-1, -1], [-1, 1], [1, -1], [1, 1]].flatMap(([p, q]) =>
        [-1, 1].flatMap((end) => {
            const point = [0, 0, 0];
            point[axis] = end;
            point[(axis + 1) % 3] = p;
            point[(axis + 2) % 3] = q;
            return point;
        }),
    ),
);

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
        const lines = new LineSegmentsGeometry().setPositions(EDGES);
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

    /** Whether it can be moved by hand. */
    turnOn(isOn) {
        this.isOn = this.handles.enabled = isOn;
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

    /** The body of the box follows the pointer in the plane of the picture. */
    addDragging() {
        const { canvas, camera } = this.stage, ray = new Raycaster(), plane = new Plane(), grip = new Vector3(), to = new Vector3();
        const aim = (event) => {
            const { left, top, width, height } = canvas.getBoundingClientRect();
            ray.setFromCamera(
                new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height),
                camera,
            );
        };
        let pointer = null;
        canvas.addEventListener('pointerdown', (event) => {
            if (pointer !== null) return this.letGo(() => (pointer = null));
            if (!this.isOn || event.button !== 0 || this.handles.dragging || this.handles.axis) return;
            aim(event);
            const [hit] = ray.intersectObject(this.faces);
            if (!hit) return;
            pointer = event.pointerId;
            plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new Vector3()), hit.point);
            grip.copy(hit.point).sub(this.pose.position);
            this.stage.orbit.enabled = this.handles.enabled = false;
            canvas.setPointerCapture(pointer);
        });
        canvas.addEventListener('pointermove', (event) => {
            if (event.pointerId !== pointer) return;
            aim(event);
            if (!ray.ray.intersectPlane(plane, to)) return;
            this.pose.position.copy(to.sub(grip));
            this.changed();
        });
        for (const end of ['pointerup', 'pointercancel'])
            canvas.addEventListener(end, (event) => event.pointerId === pointer && this.letGo(() => (pointer = null)));
    }

    letGo(forget) {
        forget();
        this.stage.orbit.enabled = this.handles.enabled = true;
    }

    paint(colours) {
        this.faces.material.color = new Color(colours.box);
        for (const line of [this.edges, this.hidden]) line.material.color = new Color(colours.box);
        this.stage.draw();
    }
}

// stage.js - the canvas, the camera and what turns it; draws when something has changed, and not otherwise.
import { PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const UP = { y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };
const FROM = { y: new Vector3(0.55, 0.5, 1), z: new Vector3(0.5, -1, 0.75) };

export class Stage {
    constructor(canvas, isStill) {
        this.canvas = canvas;
        this.isStill = isStill; // whether motion is to be reduced
        this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: 'high-performance' });
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(32, 1, 0.02, 60);
        this.beforeDraw = [];
        this.afterResize = [];
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    }

    /** After everything else that listens to the pointer, so that it comes first. */
    addOrbit() {
        this.orbit = new OrbitControls(this.camera, this.canvas);
        this.orbit.enableDamping = !this.isStill;
        this.orbit.dampingFactor = 0.12;
        this.orbit.minDistance = 0.2;
        this.orbit.maxDistance = 30;
        this.orbit.addEventListener('change', () => this.draw());
        this.lookFrom('z');
    }

    /** A view of everything, with this axis up. */
    lookFrom(up) {
        const isWide = this.camera.aspect > 1;
        this.camera.up.copy(UP[up]);
        this.camera.position
            .copy(FROM[up])
            .normalize()
            .multiplyScalar(isWide ? 3.9 : 5.4);
        this.orbit.dispose();
        const { enableDamping, dampingFactor, minDistance, maxDistance } = this.orbit;
        this.orbit = Object.assign(new OrbitControls(this.camera, this.canvas), {
            enableDamping,
            dampingFactor,
            minDistance,
            maxDistance,
        });
        this.orbit.addEventListener('change', () => this.draw());
        this.orbit.update();
        this.draw();
    }

    resize() {
        const { clientWidth, clientHeight } = this.canvas.parentElement;
        if (!clientWidth || !clientHeight) return;
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.updateProjectionMatrix();
        for (const listener of this.afterResize) listener(clientWidth, clientHeight);
        this.draw();
    }

    draw() {
        this.isWanted ??= requestAnimationFrame(() => {
            this.isWanted = null;
            this.orbit.update(); // asks for another picture while it glides
            for (const listener of this.beforeDraw) listener();
            this.renderer.render(this.scene, this.camera);
        });
    }
}

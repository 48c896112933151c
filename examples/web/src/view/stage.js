// stage.js - the canvas, the camera and what turns it; draws when something has changed, and not otherwise.
import { PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Budget, drawsInSoftware } from './budget.js';

const UP = { y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1), front: new Vector3(0, 1, 0) };
const FROM = { y: new Vector3(0.55, 0.5, 1), z: new Vector3(0.5, -1, 0.75), front: new Vector3(0, 0, 1) };
const REST_MS = 250;

/** Draws nothing, where there is no WebGL: all else goes on as if it did. */
const blind = { setPixelRatio() {}, setSize() {}, render() {}, getPixelRatio: () => 1, getContext: () => null };

function rendererOf(canvas, antialias) {
    const context = canvas.getContext('webgl2', { antialias, powerPreference: 'high-performance' });
    return context ? new WebGLRenderer({ canvas, context, alpha: true }) : blind;
}

export class Stage {
    /** above, below: what lies over the picture, and is not to cover the mesh. */
    constructor(canvas, isStill, above, below) {
        Object.assign(this, { canvas, above, below });
        this.isStill = isStill; // whether motion is to be reduced
        const software = drawsInSoftware();
        this.renderer = rendererOf(canvas, !software);
        this.isBlind = this.renderer === blind;
        this.budget = new Budget(this.renderer.getContext(), software);
        this.finest = Math.min(devicePixelRatio, software ? 1 : 2);
        this.renderer.setPixelRatio(this.finest);
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(32, 1, 0.02, 60);
        this.beforeDraw = [];
        this.afterResize = [];
        const observer = new ResizeObserver(() => this.resize());
        for (const element of [canvas.parentElement, above, below]) observer.observe(element);
    }

    /** A view of everything, or from farther away, with this axis up. Called after everything else that listens to the pointer, so that it comes first. */
    lookFrom(up, away = 3.6) {
        this.camera.up.copy(UP[up]);
        this.camera.position.copy(FROM[up]).setLength(away / Math.min(1, this.camera.aspect));
        this.orbit?.dispose();
        this.orbit = Object.assign(new OrbitControls(this.camera, this.canvas), {
            ...{ enableDamping: !this.isStill, dampingFactor: 0.12 },
            ...{ minDistance: 0.2, maxDistance: 30 },
        });
        this.orbit.addEventListener('change', () => this.draw());
        this.orbit.update();
        this.draw();
    }

    resize() {
        const { clientWidth, clientHeight } = this.canvas.parentElement;
        if (!clientWidth || !clientHeight) return;
        this.renderer.setSize(clientWidth, clientHeight, false);
        const { top } = this.canvas.getBoundingClientRect(), above = this.above.getBoundingClientRect();
        const from = above.width > 0.9 * clientWidth ? Math.max(0, above.bottom - top) : 0; // or else in a corner
        const to = this.below.offsetHeight ? this.below.offsetTop : clientHeight;
        this.camera.aspect = clientWidth / (to - from);
        this.camera.setViewOffset(clientWidth, to - from, 0, -from, clientWidth, clientHeight);
        for (const listener of this.afterResize) listener(clientWidth, clientHeight);
        this.draw();
    }

    /** Pictures follow each other with as few pixels as it takes; the last of them is drawn again with more. */
    draw(isLast = false) {
        this.isLast = isLast && !this.isWanted;
        this.isWanted ??= requestAnimationFrame(() => {
            this.isWanted = null;
            if (this.budget.isBusy()) return this.draw(this.isLast);
            const ratio = this.finest * (this.isLast ? this.budget.shareAtRest : this.budget.share);
            if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
            this.orbit.update(); // asks for another picture while it glides
            for (const listener of this.beforeDraw) listener();
            this.renderer.render(this.scene, this.camera);
            this.budget.began(!this.isLast);
            this.restLater();
        });
    }

    /** Once nothing has moved for a while, the picture is drawn with all the pixels that it can have. */
    restLater() {
        clearTimeout(this.resting);
        this.resting = setTimeout(() => {
            if (this.isWanted) return;
            if (this.budget.isBusy()) this.restLater();
            else if (this.budget.isUnsure || this.renderer.getPixelRatio() < this.finest * this.budget.shareAtRest) this.draw(true);
        }, REST_MS);
    }
}

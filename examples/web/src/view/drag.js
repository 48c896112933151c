// drag.js - what the pointer holds on the stage follows it in the plane of the picture.
import { Plane, Raycaster, Vector2, Vector3 } from 'three';

/**
 * grip: handed a ray, returns the place where it takes hold of something, or null. move: handed where that place is to be. letGo: it
 * is held no longer, as where a second finger comes.
 */
export function addDrag({ canvas, camera }, { grip, move, letGo }) {
    const ray = new Raycaster(), plane = new Plane(), to = new Vector3();
    let pointer = null;
    const aim = ({ clientX, clientY }) => {
        const { left, top, width, height } = canvas.getBoundingClientRect();
        ray.setFromCamera(new Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height), camera);
    };
    const end = () => {
        pointer = null;
        letGo();
    };
    canvas.addEventListener('pointerdown', (event) => {
        if (pointer !== null) return end();
        if (event.button !== 0) return;
        aim(event);
        const place = grip(ray);
        if (!place) return;
        pointer = event.pointerId;
        plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new Vector3()), place);
        canvas.setPointerCapture(pointer);
    });
    canvas.addEventListener('pointermove', (event) => {
        if (event.pointerId !== pointer) return;
        aim(event);
        if (ray.ray.intersectPlane(plane, to)) move(to);
    });
    for (const name of ['pointerup', 'pointercancel'])
        canvas.addEventListener(name, (event) => event.pointerId === pointer && end());
}

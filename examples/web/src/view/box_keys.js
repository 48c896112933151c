// box_keys.js - the keyboard on the canvas: moves, turns and sizes the box as the camera sees it.
import { Quaternion, Vector3 } from 'three';

const STEP = 0.02, FINE = 0.1, ANGLE = Math.PI / 36, GROWTH = 1.05;

export const ARROWS = {
    ArrowLeft: ['right', -1],
    ArrowRight: ['right', 1],
    ArrowDown: ['up', -1],
    ArrowUp: ['up', 1],
    PageDown: ['away', -1],
    PageUp: ['away', 1],
};

/** The axes of the scene that lie nearest to right, up and away as seen. */
export function axesSeen(camera) {
    const seen = { right: new Vector3(), up: new Vector3(), away: new Vector3() };
    camera.matrixWorld.extractBasis(seen.right, seen.up, seen.away);
    seen.away.negate();
    const left = ['x', 'y', 'z'], axes = {};
    for (const name of ['up', 'right', 'away']) {
        left.sort((a, b) => Math.abs(seen[name][b]) - Math.abs(seen[name][a]));
        const axis = left.shift();
        axes[name] = new Vector3();
        axes[name][axis] = Math.sign(seen[name][axis]) || 1;
    }
    return axes;
}

export function addBoxKeys(stage, box, setMode) {
    const { pose } = box;
    const move = (name, sign, factor) => pose.position.addScaledVector(axesSeen(stage.camera)[name], sign * STEP * factor);
    const turn = (name, sign, factor) => {
        const about = { right: 'up', up: 'right', away: 'away' }[name];
        const angle = (name === 'up' ? -1 : 1) * sign * ANGLE * factor;
        pose.quaternion.premultiply(new Quaternion().setFromAxisAngle(axesSeen(stage.camera)[about], angle)).normalize();
    };
    const others = {
        '+': () => pose.scale.multiplyScalar(GROWTH),
        '=': () => pose.scale.multiplyScalar(GROWTH),
        '-': () => pose.scale.multiplyScalar(1 / GROWTH),
        _: () => pose.scale.multiplyScalar(1 / GROWTH),
    };
    const modes = { m: 'translate', t: 'rotate', s: 'scale' };
    stage.canvas.addEventListener('keydown', (event) => {
        if (!box.isOn || event.ctrlKey || event.metaKey) return;
        const arrow = ARROWS[event.key], factor = event.altKey ? FINE : 1;
        if (arrow) (event.shiftKey && box.turns ? turn : move)(...arrow, factor);
        else if (others[event.key]) others[event.key]();
        else if (modes[event.key]) return setMode(modes[event.key]);
        else return;
        event.preventDefault();
        box.changed();
    });
}

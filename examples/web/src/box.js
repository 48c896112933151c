// box.js - the box in the units of the mesh: from the pose on the stage, and from numbers that were typed.
import { Matrix4, Quaternion, Vector3 } from 'three';

/** What a pose is good for, in digits to be read. Those that were typed are taken as they are. */
const rounded = (number) => Number(number.toPrecision(9));

const UPRIGHT = new Quaternion();

/** Half an ulp or so: a turn that leaves every axis where it is. */
export const isUpright = (pose) => Math.abs(pose.quaternion.dot(UPRIGHT)) > 1 - 1e-12;

export function boxOfPose(pose, { middle, scale }) {
    const center = pose.position.toArray().map((c, a) => middle[a] + scale * c);
    const half = pose.scale.toArray().map((h) => scale * h);
    if (isUpright(pose))
        return { lo: center.map((c, a) => rounded(c - half[a])), hi: center.map((c, a) => rounded(c + half[a])) };
    const matrix = new Matrix4().makeRotationFromQuaternion(pose.quaternion).elements;
    const axes = [0, 1, 2, 4, 5, 6, 8, 9, 10].map((e) => rounded(matrix[e]));
    return { turned: true, center: center.map(rounded), half: half.map(rounded), axes };
}

export function poseBox(pose, { middle, scale }, box) {
    const center = box.center ?? box.lo.map((l, a) => l / 2 + box.hi[a] / 2);
    const half = box.half ?? box.lo.map((l, a) => box.hi[a] / 2 - l / 2);
    pose.position.fromArray(center.map((c, a) => (c - middle[a]) / scale));
    pose.scale.fromArray(half.map((h) => h / scale));
    pose.quaternion.identity();
    if (box.turned) {
        const [u, v, w] = [0, 3, 6].map((at) => new Vector3().fromArray(box.axes, at));
        pose.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(u, v, w)).normalize();
    }
}

const numbersOf = (box) => (box.turned ? [...box.center, ...box.half, ...box.axes] : [...box.lo, ...box.hi]);

export const textOfBox = (box) => numbersOf(box).map(String).join(',');

/** Six numbers are an upright box, fifteen a turned one; throws if the text is neither. */
export function boxOfText(text) {
    const numbers = text.trim().split(/[\s,]+/).map(Number), isTurned = numbers.length === 15;
    if (!numbers.every(Number.isFinite) || (numbers.length !== 6 && !isTurned))
        throw new Error('six numbers are wanted, the lower corner and then the upper: 0,0,0,1,1,1');
    const axis = [0, 1, 2].find((a) => (isTurned ? 0 : numbers[a]) > numbers[3 + a]);
    if (axis !== undefined) throw new Error(`${isTurned ? 'half length less than 0' : 'lower exceeds upper'} on ${'xyz'[axis]}`);
    if (!isTurned) return { lo: numbers.slice(0, 3), hi: numbers.slice(3) };
    return { turned: true, center: numbers.slice(0, 3), half: numbers.slice(3, 6), axes: numbers.slice(6) };
}

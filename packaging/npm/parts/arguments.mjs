// arguments.mjs - reads what callers give, and says what is wrong with it.
import { shown } from './errors.mjs';

const letters = 'xyz';

export const isObject = (value) => typeof value === 'object' && value !== null;

export const isTypedArray = (value, kinds) => kinds.some((kind) => value instanceof kind);

/** An index or a count: from least to most. */
export function whole(value, name, least, most, advice) {
    if (typeof value !== 'number')
        throw new TypeError(`${name} = ${shown(value)}: give a whole number`);
    if (!Number.isInteger(value) || value < least || value > most)
        throw new RangeError(`${name} = ${shown(value)}: give a whole number from ${least} to ${most}${
            advice ? `, ${advice}` : ''}`);
    return value;
}

/** Three numbers of [x, y, z] or {x, y, z}. */
export function vector(value, name) {
    let three;
    if (isObject(value))
        three = typeof value.length === 'number' ? value.length === 3 && [value[0], value[1], value[2]] :
            [value.x, value.y, value.z];
    if (!three || !three.every((number) => typeof number === 'number'))
        throw new TypeError(`${name} = ${shown(value)}: give three numbers, [x, y, z] or {x, y, z}`);
    return three;
}

/** Three finite numbers. */
export function finite(value, name) {
    const three = vector(value, name);
    three.forEach((number, a) => {
        if (!Number.isFinite(number))
            throw new RangeError(`${name}: ${letters[a]} is ${number}; give finite numbers`);
    });
    return three;
}

/** The six numbers of a box, lower ones first. */
export function boxNumbers(box) {
    const names = isObject(box) && (['lo', 'hi'].every((key) => key in box) ? ['lo', 'hi'] : ['min', 'max']);
    if (!names || !names.every((key) => key in box))
        throw new TypeError(`box = ${shown(box)}: give {lo: [x, y, z], hi: [x, y, z]}, or {min, max}`);
    return names.flatMap((key) => finite(box[key], `box.${key}`));
}

export const isOriented = (box) => isObject(box) && 'center' in box;

/** The fifteen numbers of an oriented box, as tribox_oriented_box has them. */
export function orientedBoxNumbers(box) {
    if (!Array.isArray(box.axis) || box.axis.length !== 3)
        throw new TypeError(`box.axis = ${shown(box.axis)}: give the directions of three axes, [[x, y, z], [x, y, z], [x, y, z]]`);
    const axes = box.axis.flatMap((axis, k) => finite(axis, `box.axis[${k}]`));
    return [...finite(box.center, 'box.center'), ...finite(box.half, 'box.half'), ...axes];
}

/** Throws if there is an option that the call does not know. */
export function checkKeys(options, known) {
    if (options === undefined)
        return;
    if (!isObject(options))
        throw new TypeError(`options = ${shown(options)}: give an object, such as {accuracy: 'exact'}`);
    for (const key of Object.keys(options))
        if (!known.includes(key))
            throw new TypeError(`options.${key} is unknown; there are ${known.join(', ')}`);
}

const accuracies = ['exact', 'conservative', 'fast'];
const groups = { box: 1, plane: 2, edges: 4 };
const orders = [123, 132, 213, 231, 312, 321];

export function oneOf(value, name, known) {
    if (!known.includes(value))
        throw new RangeError(`${name} = ${shown(value)}: give one of ${known.map(shown).join(', ')}`);
    return value;
}

/** The groups of axes as bits; 0 for all. */
export function axesBits(axes) {
    if (axes === undefined)
        return 0;
    if (!Array.isArray(axes) || !axes.length)
        throw new TypeError(`options.axes = ${shown(axes)}: give a list of groups, such as ['box', 'plane', 'edges']`);
    return axes.reduce((bits, group) => bits | groups[oneOf(group, 'options.axes', Object.keys(groups))], 0);
}

/** Accuracy, axes and their order, as tribox_options has them. */
export function optionNumbers(options = {}) {
    return [
        accuracies.indexOf(oneOf(options.accuracy ?? 'exact', 'options.accuracy', accuracies)),
        axesBits(options.axes),
        options.axisOrder === undefined ? 0 : oneOf(options.axisOrder, 'options.axisOrder', orders),
    ];
}

/** What all calls know. */
export const optionKeys = ['accuracy', 'axes', 'axisOrder'];

/** The numbers, copied if they lie in the memory itself: such a view dies when the memory grows for what is made of them. */
const lasting = (numbers, memory) => (numbers?.buffer === memory.buffer ? numbers.slice() : numbers);

/** Throws if the numbers are gone, which leaves an empty view. */
function checkThere(numbers, name) {
    try {
        new Uint8Array(numbers.buffer);
    } catch {
        throw new TypeError(`${name} is a view of a memory that has grown since, or was posted away: make the view anew`);
    }
}

/** The positions and indices of a mesh that is to be copied into the memory, and its numbers of vertices and triangles. */
export function meshArrays(memory, mesh, kinds, otherwise) {
    if (!isObject(mesh))
        throw new TypeError(`mesh = ${shown(mesh)}: give {positions, indices}`);
    const { positions, indices = null } = mesh;
    if (!isTypedArray(positions, kinds))
        throw new TypeError(`mesh.positions = ${shown(positions)}: ${otherwise(positions)}`);
    if (indices !== null && !isTypedArray(indices, [Uint32Array, Uint16Array]))
        throw new TypeError(`mesh.indices = ${shown(indices)}: give a Uint32Array or a Uint16Array`);
    checkThere(positions, 'mesh.positions');
    if (indices)
        checkThere(indices, 'mesh.indices');
    if (positions.length % (indices ? 3 : 9))
        throw new RangeError(`mesh.positions has ${positions.length} numbers: give ${
            indices ? 'three a vertex' : 'nine a triangle, or indices'}`);
    if (indices && indices.length % 3)
        throw new RangeError(`mesh.indices has ${indices.length} numbers: give three a triangle`);
    const vertices = positions.length / 3;
    if (indices)
        checkIndices(indices, vertices);
    const count = (indices ?? positions).length / (indices ? 3 : 9);
    return { positions: lasting(positions, memory), indices: lasting(indices, memory), vertices, count };
}

function checkIndices(indices, vertices) {
    for (let k = 0; k < indices.length; k++)
        if (indices[k] >= vertices)
            throw new RangeError(`mesh.indices[${k}] = ${indices[k]}: the mesh has ${vertices} vertices, numbered from 0`);
}

// scenes.js - the meshes that the page has without a file, and the box that each begins with.
import { knot } from './knot.js';
import { paperScene, tiesScene } from './random.js';

const KNOT_BOX = { center: [1.2, 0.4, 0], half: [1, 1, 1] };

const knotOf = (rings, corners) => ({
    make: () => knot(rings, corners),
    box: KNOT_BOX,
});

/** frame: what the view makes 0 and 1, if not by the mesh. */
export const scenes = {
    some: { title: 'Knot, 8,000 triangles', ...knotOf(250, 16) },
    coarse: { title: 'Knot, 10,000 triangles', ...knotOf(250, 20) },
    knot: { title: 'Knot, 200,000 triangles', ...knotOf(1000, 100) },
    million: { title: 'Knot, 1,000,000 triangles', ...knotOf(2500, 200) },
    paper: {
        title: "The paper's 100,000 at random",
        make: () => paperScene(100000),
        box: { center: [0, 0, 0], half: [0.5, 0.5, 0.5] },
    },
    ties: { title: 'Ties: 600 that graze the box', make: () => tiesScene(600), box: { center: [0, 0, 0], half: [1, 1, 1] } },
    grazing: { title: 'Ties: 30 large ones', make: () => tiesScene(30, 5), box: { center: [0, 0, 0], half: [1, 1, 1] } },
    /** Two of each kind: apart by normals of the box, by their own, by edges, and not at all. */
    eight: {
        title: 'Eight triangles',
        make: () =>
            Float32Array.of(
                ...[-0.5, -0.875, -1.25, -1.25, -2.125, -2, -1.375, -1.75, -0.875],
                ...[0.75, 0, -0.75, 0.875, -1.625, -1.75, 1.5, -0.25, -1.875],
                ...[-1.75, 1.125, -0.625, -0.375, 1.75, -1.5, -1.625, 0.625, -1.5],
                ...[2.25, 2, -2.125, 1.5, 1.625, -0.875, 0.75, 0.375, -1.875],
                ...[-1.125, -0.875, 0.875, -2, -1.5, 0.375, -1.75, -1.25, 1.625],
                ...[1.625, -0.75, 1.25, 1.25, -0.25, 1.75, 1.125, -1.75, 0.125],
                ...[-2.125, 0.375, 0.375, -0.75, 1.375, 1.25, -0.625, 0.5, 0.5],
                ...[0.75, 0.5, 2.25, 1.25, 1.75, 0.875, 1.25, 0.125, 1.375],
            ),
        frame: { middle: [0, 0, 0], scale: 3 },
        box: { center: [0, 0, 0], half: [1, 1, 1] },
    },
    one: {
        title: 'One triangle',
        make: () => Float32Array.of(-1.875, -0.625, 0.25, -1.875, 0.125, 1.375, -0.5, 1.25, 2), // apart on a12 alone
        frame: { middle: [0, 0, 0], scale: 2.5 },
        box: { center: [0, 0, 0], half: [1, 1, 1] },
    },
};

// scenes.js - the meshes that the page has without a file, and the box that each begins with.
import { knot } from './knot.js';
import { paperScene, tiesScene } from './random.js';

const KNOT_BOX = { center: [1.2, 0.4, 0], half: [1, 1, 1] };

export const scenes = {
    knot: { title: 'Knot, 200,000 triangles', make: () => knot(1000, 100), box: KNOT_BOX },
    million: { title: 'Knot, 1,000,000 triangles', make: () => knot(2500, 200), box: KNOT_BOX },
    coarse: { title: 'Knot, 10,000 triangles', make: () => knot(250, 20), box: KNOT_BOX },
    paper: {
        title: "The paper's: 100,000 at random",
        make: () => paperScene(100000),
        box: { center: [0, 0, 0], half: [0.5, 0.5, 0.5] },
    },
    ties: { title: 'Ties: 600 that graze the box', make: () => tiesScene(600), box: { center: [0, 0, 0], half: [1, 1, 1] } },
};

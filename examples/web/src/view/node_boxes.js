// node_boxes.js - the boxes of an index that a question came by: of its nodes, and of the words whose triangles were tested.
import { BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments } from 'three';

/** The ends of the twelve edges of a box, each coordinate low or high. */
export const EDGES = [0, 1, 2].flatMap((axis) =>
    [0, 1, 2, 3].flatMap((side) =>
        [0, 1].map((end) => {
            const corner = [0, 0, 0];
            corner[axis] = end;
            corner[(axis + 1) % 3] = side & 1;
            corner[(axis + 2) % 3] = side >> 1;
            return corner;
        }),
    ),
);

export class NodeBoxes {
    constructor(stage) {
        this.stage = stage;
        this.kinds = { nodes: 0.5, words: 0.5 };
        for (const [kind, opacity] of Object.entries(this.kinds)) {
            const material = new LineBasicMaterial({ transparent: true, opacity, toneMapped: false });
            this[kind] = new LineSegments(new BufferGeometry(), material);
            this[kind].frustumCulled = false;
            stage.scene.add(this[kind]);
        }
    }

    /** visits: six numbers a box; null for none. */
    show(visits, { middle, scale }) {
        for (const kind of Object.keys(this.kinds)) {
            const boxes = visits?.[kind] ?? [], places = new Float32Array((boxes.length / 6) * EDGES.length * 3);
            let at = 0;
            for (let box = 0; box < boxes.length; box += 6)
                for (const corner of EDGES)
                    for (let a = 0; a < 3; a++) places[at++] = (boxes[box + 3 * corner[a] + a] - middle[a]) / scale;
            this[kind].geometry.dispose();
            this[kind].geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3));
            this[kind].visible = places.length > 0;
        }
    }

    paint(colours) {
        this.nodes.material.color = new Color(colours.soft); // the box that is asked about is heavier
        this.words.material.color = new Color(colours.straddling);
    }
}

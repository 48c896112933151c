// visits.js - which nodes of an index a box comes by, told as the library does: by the bounds in the nodes
// (src/index/kernel_nodes.h).

const CHILDREN = 64,
    NODE_FLOATS = 400; // six rows of bounds, one of each child; then what is not needed here

/** The levels of an index over so many triangles, the lowest first: its nodes, and which is the first of them. */
function levelsOf(triangles) {
    const levels = [];
    let children = Math.ceil(triangles / 64), first = 0;
    do {
        const nodes = Math.max(1, Math.ceil(children / CHILDREN));
        levels.push({ first, nodes, children });
        first += nodes;
        children = nodes;
    } while (children > 1);
    return levels;
}

/**
 * floats: the memory from the first node on. Returns how many nodes there are, the boxes of those that were looked at, and of the
 * words of 64 triangles that had to be tested: six numbers each.
 */
export function visitsOf(floats, triangles, { lo, hi }) {
    const levels = levelsOf(triangles), nodes = [], words = [];
    let asked = [0];
    for (const { first, children } of levels.reverse()) {
        const isLowest = first === 0, next = [];
        for (const node of asked)
            for (let c = 0; c < Math.min(CHILDREN, children - CHILDREN * node); c++) {
                const bound = Array.from({ length: 6 }, (_, row) => floats[NODE_FLOATS * (first + node) + CHILDREN * row + c]);
                const axes = [0, 1, 2];
                if (!axes.every((a) => bound[a] <= hi[a] && bound[3 + a] >= lo[a])) continue;
                const isInside = axes.every((a) => bound[a] >= lo[a] && bound[3 + a] <= hi[a]);
                if (isInside) continue;
                (isLowest ? words : nodes).push(...bound);
                if (!isLowest) next.push(CHILDREN * node + c);
            }
        asked = next;
    }
    return {
        nodes: Float32Array.from(nodes),
        words: Float32Array.from(words),
        ofNodes: levels.reduce((sum, level) => sum + level.nodes, 0),
        ofWords: Math.ceil(triangles / 64),
    };
}

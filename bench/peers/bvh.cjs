// Builds a tree of three-mesh-bvh and asks it about boxes, all in files of a folder; says the least seconds of either.
const {readFileSync, writeFileSync} = require("fs");
const {join, dirname} = require("path");
const THREE = require("three");
const {MeshBVH, NOT_INTERSECTED, INTERSECTED, CONTAINED} = require("three-mesh-bvh");

const ROUNDS = 2, [, , folder] = process.argv;
const read = (name, type) => new type(new Uint8Array(readFileSync(join(folder, name))).buffer);

function build() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(read("vertices", Float32Array), 3));
    geometry.setIndex(new THREE.BufferAttribute(read("faces", Uint32Array), 1));
    return timed(() => new MeshBVH(geometry, {indirect: true})); // with the numbers of the file
}

function ask(tree, bounds) {
    const numbers = [], start = [0], box = new THREE.Box3();
    for (let b = 0; b < bounds.length; b += 6) {
        box.min.fromArray(bounds, b), box.max.fromArray(bounds, b + 3);
        tree.shapecast({
            intersectsBounds: node => !box.intersectsBox(node) ? NOT_INTERSECTED : box.containsBox(node) ? CONTAINED : INTERSECTED,
            intersectsTriangle: (triangle, number, isContained) => {
                if (isContained || box.intersectsTriangle(triangle))
                    numbers.push(number);
            },
        });
        start.push(numbers.length);
    }
    return {numbers, start};
}

function timed(call) {
    const cpu = process.cpuUsage(), wall = performance.now(), answer = call(), used = process.cpuUsage(cpu);
    return [answer, [(used.user + used.system) / 1e6, (performance.now() - wall) / 1e3]];
}

if (folder) {
    const rounds = Array.from({length: ROUNDS}, () => {
        const [tree, built] = build(), [answer, asked] = timed(() => ask(tree, read("boxes", Float64Array)));
        return {answer, times: [built, asked]};
    });
    for (const name of ["numbers", "start"])
        writeFileSync(join(folder, name), Uint32Array.from(rounds[0].answer[name]));
    console.log(JSON.stringify([0, 1].map(way => [0, 1].map(clock => Math.min(...rounds.map(r => r.times[way][clock]))))));
} else {
    const about = JSON.parse(readFileSync(join(dirname(require.resolve("three-mesh-bvh")), "..", "package.json")));
    process.stdout.write(`three-mesh-bvh ${about.version}`);
}

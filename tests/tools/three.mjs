// three.mjs - reads meshes by the loaders of three.js: three.mjs FOLDER FILE..., FOLDER that of the package. Prints, for each, the
// corners of its triangles and their colours, linear, as three.js has them.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, ...paths] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(join(folder, name)));
const three = await load('build/three.module.js');
const { GLTFLoader } = await load('examples/jsm/loaders/GLTFLoader.js');
const { PLYLoader } = await load('examples/jsm/loaders/PLYLoader.js');
const { OBJLoader } = await load('examples/jsm/loaders/OBJLoader.js');

async function read(path) {
    const bytes = readFileSync(path), buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
    if (path.endsWith('.ply')) return new three.Mesh(new PLYLoader().parse(buffer), new three.MeshBasicMaterial());
    if (path.endsWith('.obj')) return new OBJLoader().parse(bytes.toString());
    return (await new GLTFLoader().parseAsync(buffer, '')).scene;
}

const found = [];
for (const path of paths) {
    const corners = [], colours = [];
    let isShown = true;
    const scene = await read(path);
    scene.updateMatrixWorld(true);
    scene.traverse((mesh) => {
        if (!mesh.isMesh) return;
        const whole = mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry, { position, color } = whole.attributes;
        if (path.endsWith('.glb')) isShown = mesh.material.vertexColors && mesh.material.metalness === 0;
        for (let i = 0; i < position.count; i++) {
            corners.push(new three.Vector3().fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld).toArray());
            colours.push([color.getX(i), color.getY(i), color.getZ(i)]);
        }
    });
    found.push({ corners, colours, isShown });
}
console.log(JSON.stringify(found));

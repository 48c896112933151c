// cells.js - the cells of a voxelization as cubes, one instance each.
import { BoxGeometry, Color, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, Vector3 } from 'three';
import { listCells } from './cell_list.js';
import { setSrgb } from './triangles.js';

/** What a phone still draws; more are counted, and not drawn. */
const MOST_CELLS = 200000;

/** By the axis that is up. */
const LIGHT_FROM = { z: [0.14, -0.1, 0.28], y: [0.14, 0.28, 0.1] };

const vertexShader = /* glsl */ `
uniform vec3 origin, cell;
in vec3 at;
out vec3 seen, side;
out vec3 place;
void main() {
    vec4 where = modelViewMatrix * vec4(origin + cell * (at + position), 1);
    seen = where.xyz;
    side = normal;
    place = position;
    gl_Position = projectionMatrix * where;
}`;

const fragmentShader = /* glsl */ `
uniform vec3 colour, light_from;
in vec3 seen, side, place;
out vec4 pixel;
void main() {
    float light = 0.72 + dot(side, light_from);
    vec3 off = min(place, 1.0 - place) + abs(side); // of the two axes along the face
    vec3 width = max(fwidth(place), vec3(1e-6));
    vec3 near_edge = smoothstep(vec3(0), width * 1.2, off);
    float edge = 1.0 - min(near_edge.x, min(near_edge.y, near_edge.z));
    float size = 1.0 / max(width.x, max(width.y, width.z));
    pixel = vec4(colour * light * (1.0 - 0.45 * edge * smoothstep(3.0, 10.0, size)), 1);
}`;

export class Cells {
    constructor(stage) {
        this.stage = stage;
        this.uniforms = {
            origin: { value: new Vector3() },
            cell: { value: new Vector3() },
            colour: { value: new Color() },
            light_from: { value: new Vector3() },
        };
        this.mesh = new Mesh(
            new InstancedBufferGeometry(),
            new ShaderMaterial({
                glslVersion: GLSL3,
                uniforms: this.uniforms,
                vertexShader,
                fragmentShader,
            }),
        );
        this.mesh.frustumCulled = false;
        this.mesh.visible = false;
        stage.scene.add(this.mesh);
    }

    /** Draws the first cells of the grid, by layers from below. Returns how many there are, and how many are drawn. */
    show(grid, bits, { up, frame: { middle, scale } }) {
        const { at, count, drawn } = listCells(grid.size, bits, MOST_CELLS);
        const unit = new BoxGeometry().translate(0.5, 0.5, 0.5),
            geometry = new InstancedBufferGeometry();
        geometry.index = unit.index;
        for (const name of ['position', 'normal']) geometry.setAttribute(name, unit.getAttribute(name));
        geometry.setAttribute('at', new InstancedBufferAttribute(at, 3));
        geometry.instanceCount = drawn;
        this.mesh.geometry.dispose();
        this.mesh.geometry = geometry;
        this.uniforms.origin.value.fromArray(grid.origin.map((o, a) => (o - middle[a]) / scale));
        this.uniforms.cell.value.fromArray(grid.cell.map((c) => c / scale));
        this.uniforms.light_from.value.fromArray(LIGHT_FROM[up]);
        this.mesh.visible = true;
        this.stage.draw();
        return { count, drawn };
    }

    hide() {
        this.mesh.visible = false;
        this.stage.draw();
    }

    paint(colours) {
        setSrgb(this.uniforms.colour.value, colours.cells);
    }
}

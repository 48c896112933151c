// cells.js - the cells of a voxelization by their faces: those in the box in its colours. Without a graphics card instances would
// take five times as long, each being a call of its own there.
import { BufferAttribute, BufferGeometry, Color, GLSL3, IntType, Mesh, ShaderMaterial, Vector3 } from 'three';
import { listFaces } from './face_list.js';
import { setSrgb } from './triangles.js';

/** By the axis that is up. */
const LIGHT_FROM = { z: [0.14, -0.1, 0.28], y: [0.14, 0.28, 0.1] };

/** Four vertices a face. at: a cell, and which side of it. */
const vertexShader = /* glsl */ `
uniform vec3 origin, cell, box_lo, box_hi, light_from;
uniform vec3 cells_colour, straddling_colour, inside_colour;
in uvec4 at;
flat out vec3 colour;
out vec2 place;
void main() {
    int axis = int(at.w) / 2, end = int(at.w) % 2;
    int turn = gl_VertexID % 4;
    vec2 square = vec2(turn == 1 || turn == 2, turn > 1);
    place = end == 1 ? square : square.yx; // seen from outside, corners go round one way
    vec3 corner = vec3(end);
    corner[(axis + 1) % 3] = place.x;
    corner[(axis + 2) % 3] = place.y;
    vec3 side = vec3(0);
    side[axis] = float(2 * end - 1);
    vec3 lo = origin + cell * vec3(at.xyz), hi = lo + cell;
    bool is_apart = any(greaterThan(lo, box_hi)) || any(lessThan(hi, box_lo));
    bool is_inside = all(greaterThanEqual(lo, box_lo)) && all(lessThanEqual(hi, box_hi));
    colour = (is_apart ? cells_colour : is_inside ? inside_colour : straddling_colour) * (0.72 + dot(side, light_from));
    gl_Position = projectionMatrix * modelViewMatrix * vec4(lo + cell * corner, 1);
}`;

const fragmentShader = /* glsl */ `
flat in vec3 colour;
in vec2 place;
out vec4 pixel;
void main() {
    vec2 width = max(fwidth(place), vec2(1e-6));
    vec2 near_edge = smoothstep(vec2(0), width * 1.2, min(place, 1.0 - place));
    float edge = 1.0 - min(near_edge.x, near_edge.y);
    float size = 1.0 / max(width.x, width.y);
    pixel = vec4(colour * (1.0 - 0.45 * edge * smoothstep(3.0, 10.0, size)), 1);
}`;

const MOST_FACES = 1e6, SQUARE = [0, 1, 2, 0, 2, 3];

export class Cells {
    constructor(stage) {
        this.stage = stage;
        const vector = () => ({ value: new Vector3() }), colour = () => ({ value: new Color() });
        this.uniforms = {
            ...{ origin: vector(), cell: vector(), box_lo: vector(), box_hi: vector(), light_from: vector() },
            ...{ cells_colour: colour(), straddling_colour: colour(), inside_colour: colour() },
        };
        this.mesh = new Mesh(
            new BufferGeometry(),
            new ShaderMaterial({ glslVersion: GLSL3, uniforms: this.uniforms, vertexShader, fragmentShader }),
        );
        this.mesh.frustumCulled = false;
        this.mesh.visible = false;
        stage.scene.add(this.mesh);
    }

    /** The faces that these cells show, and how many cells there are; more than are drawn are none. */
    facesOf(grid, bits) {
        return listFaces(grid.size, bits, Math.min(MOST_FACES, this.stage.budget.most.triangles / 2));
    }

    show(grid, at, { up, frame: { middle, scale } }) {
        const faces = at.length / 4, ofVertices = new Uint16Array(4 * at.length), corners = new Uint32Array(6 * faces);
        for (let face = 0; face < faces; face++) {
            const four = at.subarray(4 * face, 4 * face + 4);
            for (let v = 0; v < 4; v++) ofVertices.set(four, 16 * face + 4 * v);
            SQUARE.forEach((v, i) => (corners[6 * face + i] = 4 * face + v));
        }
        const numbers = Object.assign(new BufferAttribute(ofVertices, 4), { gpuType: IntType });
        const geometry = new BufferGeometry().setAttribute('at', numbers).setIndex(new BufferAttribute(corners, 1));
        this.mesh.geometry.dispose();
        this.mesh.geometry = geometry;
        this.uniforms.origin.value.fromArray(grid.origin.map((o, a) => (o - middle[a]) / scale));
        this.uniforms.cell.value.fromArray(grid.cell.map((c) => c / scale));
        this.uniforms.light_from.value.fromArray(LIGHT_FROM[up]);
        this.mesh.visible = true;
        this.stage.draw();
    }

    /** box: null for one that is turned, which colours nothing. */
    colour(box, { middle, scale }) {
        for (const [name, end] of Object.entries({ box_lo: box?.lo, box_hi: box?.hi }))
            this.uniforms[name].value.fromArray(end ? end.map((x, a) => (x - middle[a]) / scale) : [9, 9, 9]);
    }

    hide() {
        this.mesh.visible = false;
        this.stage.draw();
    }

    paint(colours) {
        for (const name of ['cells', 'straddling', 'inside']) setSrgb(this.uniforms[`${name}_colour`].value, colours[name]);
    }
}

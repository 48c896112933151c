// triangles.js - the mesh, each triangle in the colour of its class: missed, straddling, inside, or unlike EXACT.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, GLSL3, Mesh, Points, ShaderMaterial, Sphere, Vector3 } from 'three';
import { BitTexture, readBit } from './bit_texture.js';

const vertexShader = /* glsl */ `
uniform highp usampler2D mask, inside, unlike;
uniform vec3 missed_colour, straddling_colour, inside_colour, unlike_colour;
flat out vec3 colour;
out vec3 seen, corner;
${readBit}
void main() {
    int triangle = gl_VertexID / 3, v = gl_VertexID % 3;
    colour = bit_of(unlike, triangle) ? unlike_colour
           : bit_of(inside, triangle) ? inside_colour
           : bit_of(mask, triangle) ? straddling_colour : missed_colour;
    corner = vec3(v == 0, v == 1, v == 2);
    vec4 place = modelViewMatrix * vec4(position, 1);
    seen = place.xyz;
    gl_Position = projectionMatrix * place;
}`;

/* Flat, lit from the eye and from above; edges where triangles are large enough on the screen to be told apart. */
const fragmentShader = /* glsl */ `
uniform float edge_strength;
flat in vec3 colour;
in vec3 seen, corner;
out vec4 pixel;
void main() {
    vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
    vec3 eye = normalize(-seen);
    float facing = abs(dot(normal, eye));
    float above = 0.5 + 0.5 * dot(normal, normalize(vec3(-0.35, 0.85, 0.4)));
    vec3 lit = colour * (0.32 + 0.40 * facing + 0.38 * above * above);
    vec3 width = fwidth(corner);
    float size = 1.0 / max(max(width.x, width.y), max(width.z, 1e-6)); // pixels, about
    vec3 near_edge = smoothstep(vec3(0), width * 1.1, corner);
    float edge = 1.0 - min(near_edge.x, min(near_edge.y, near_edge.z));
    lit *= 1.0 - edge * edge_strength * smoothstep(5.0, 16.0, size);
    pixel = vec4(lit, 1);
}`;

const markVertex = /* glsl */ `
void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1);
    gl_PointSize = MARK_SIZE;
}`;

/* A ring, over everything. */
const markFragment = /* glsl */ `
uniform vec3 unlike_colour;
out vec4 pixel;
void main() {
    float r = length(gl_PointCoord - 0.5) * MARK_SIZE;
    float ring = 1.0 - smoothstep(1.0, 2.0, abs(r - (MARK_SIZE * 0.5 - 3.0)));
    if (ring < 0.02) discard;
    pixel = vec4(unlike_colour * ring, ring);
}`;

const MOST_MARKS = 2000;

export class Triangles {
    constructor(stage) {
        this.stage = stage;
        const colour = () => ({ value: new Color() });
        this.uniforms = {
            mask: { value: null },
            inside: { value: null },
            unlike: { value: null },
            edge_strength: { value: 0.35 },
            missed_colour: colour(),
            straddling_colour: colour(),
            inside_colour: colour(),
            unlike_colour: colour(),
        };
        this.mesh = new Mesh(
            new BufferGeometry(),
            new ShaderMaterial({
                glslVersion: GLSL3,
                uniforms: this.uniforms,
                vertexShader,
                fragmentShader,
                side: DoubleSide,
                polygonOffset: true,
                polygonOffsetFactor: 1,
                polygonOffsetUnits: 1,
            }),
        );
        this.marks = new Points(
            new BufferGeometry(),
            new ShaderMaterial({
                glslVersion: GLSL3,
                uniforms: this.uniforms,
                vertexShader: markVertex,
                fragmentShader: markFragment,
                transparent: true,
                premultipliedAlpha: true,
                depthTest: false,
                defines: { MARK_SIZE: (12 * stage.renderer.getPixelRatio()).toFixed(1) },
            }),
        );
        this.mesh.frustumCulled = this.marks.frustumCulled = false;
        this.marks.renderOrder = 3;
        stage.scene.add(this.mesh, this.marks);
    }

    /** frame: what the view makes the origin and the unit, in double, so that far meshes do not tremble. */
    show(triangles, { middle, scale }) {
        const places = new Float32Array(triangles.length);
        for (let i = 0; i < places.length; i++) {
            const place = (triangles[i] - middle[i % 3]) / scale;
            places[i] = Number.isFinite(place) ? place : 0;
        }
        this.mesh.geometry.dispose();
        this.mesh.geometry = new BufferGeometry();
        this.mesh.geometry.setAttribute('position', new BufferAttribute(places, 3));
        this.mesh.geometry.boundingSphere = new Sphere(new Vector3(), 2);
        for (const name of ['mask', 'inside', 'unlike']) {
            this[name]?.dispose();
            this[name] = new BitTexture(triangles.length / 9);
            this.uniforms[name].value = this[name].texture;
        }
        this.places = places;
        this.mark([]);
    }

    classify({ mask, inside, unlike }) {
        this.mask.set(mask);
        this.inside.set(inside);
        if (unlike || this.hasUnlike) this.unlike.set(unlike);
        this.hasUnlike = Boolean(unlike);
        this.stage.draw();
    }

    /** Rings around the middles of these triangles. */
    mark(numbers) {
        const shown = numbers.slice(0, MOST_MARKS),
            middles = new Float32Array(3 * shown.length);
        shown.forEach((n, m) => {
            for (let a = 0; a < 3; a++)
                middles[3 * m + a] = (this.places[9 * n + a] + this.places[9 * n + 3 + a] + this.places[9 * n + 6 + a]) / 3;
        });
        this.marks.geometry.dispose();
        this.marks.geometry = new BufferGeometry();
        this.marks.geometry.setAttribute('position', new BufferAttribute(middles, 3));
        this.marks.visible = shown.length > 0;
        this.stage.draw();
    }

    paint(colours) {
        for (const name of ['missed', 'straddling', 'inside', 'unlike'])
            setSrgb(this.uniforms[`${name}_colour`].value, colours[name]);
        this.stage.draw();
    }
}

/** The shaders write colours as they are. */
export function setSrgb(color, text) {
    const number = parseInt(text.slice(1), 16);
    color.r = (number >> 16) / 255;
    color.g = ((number >> 8) & 255) / 255;
    color.b = (number & 255) / 255;
}

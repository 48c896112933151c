// triangles.js - the mesh, each triangle in the colour of its class: missed, straddling, inside, or unlike EXACT. Of a mesh that is
// more than is drawn, those that straddle, and something coarser of all.
import {
    BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, GLSL3, Mesh, NearestFilter, Points, RedIntegerFormat,
    ShaderMaterial, UnsignedIntType,
} from 'three';
import { listBits } from '../bits.js';

const WIDTH = 1024;

class BitTexture {
    constructor(bits) {
        const height = Math.max(1, Math.ceil(bits / 32 / WIDTH));
        this.words = new Uint32Array(WIDTH * height);
        this.texture = new DataTexture(this.words, WIDTH, height, RedIntegerFormat, UnsignedIntType);
        this.texture.internalFormat = 'R32UI';
        this.texture.minFilter = this.texture.magFilter = NearestFilter;
        this.texture.needsUpdate = true;
    }

    /** words: null for none set. */
    set(words) {
        if (words) this.words.set(words);
        else this.words.fill(0);
        this.texture.needsUpdate = true;
    }

    dispose() {
        this.texture.dispose();
    }
}

const readBit = /* glsl */ `
bool bit_of(highp usampler2D words, int i) {
    int word = i >> 5;
    return (texelFetch(words, ivec2(word & ${WIDTH - 1}, word / ${WIDTH}), 0).r >> uint(i & 31) & 1u) == 1u;
}`;

const vertexShader = /* glsl */ `
uniform highp usampler2D mask, inside, unlike;
uniform vec3 missed_colour, straddling_colour, inside_colour, unlike_colour;
#ifdef IS_NUMBERED
in uint number;
#endif
flat out vec3 colour;
flat out float edge_strength;
out vec3 seen, corner;
${readBit}
void main() {
    int triangle = gl_VertexID / 3, v = gl_VertexID % 3;
#ifdef IS_NUMBERED
    triangle = int(number);
#endif
    bool is_inside = bit_of(inside, triangle), is_straddling = !is_inside && bit_of(mask, triangle);
    colour = bit_of(unlike, triangle) ? unlike_colour
           : is_inside ? inside_colour
           : is_straddling ? straddling_colour : missed_colour;
    edge_strength = is_inside || is_straddling ? 0.6 : 0.3;
    corner = vec3(v == 0, v == 1, v == 2);
    vec4 place = modelViewMatrix * vec4(position, 1);
    seen = place.xyz;
    gl_Position = projectionMatrix * place;
}`;

/* Flat, lit from the eye and from above; edges where triangles are large enough on the screen to be told apart. */
const fragmentShader = /* glsl */ `
flat in vec3 colour;
flat in float edge_strength;
uniform float pixel_ratio;
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
    lit *= 1.0 - edge * edge_strength * smoothstep(4.0, 12.0, size / pixel_ratio);
    pixel = vec4(lit, 1);
}`;

const markVertex = /* glsl */ `
uniform float mark_size;
void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1);
    gl_PointSize = mark_size;
}`;

/* A ring, over everything. */
const markFragment = /* glsl */ `
uniform vec3 unlike_colour;
uniform float mark_size;
out vec4 pixel;
void main() {
    float r = length(gl_PointCoord - 0.5) * mark_size;
    float ring = 1.0 - smoothstep(1.0, 2.0, abs(r - (mark_size * 0.5 - 3.0)));
    if (ring < 0.02) discard;
    pixel = vec4(unlike_colour * ring, ring);
}`;

const MOST_MARKS = 2000,
    LARGE = 100; // so few are large enough to be seen without a ring

const surface = { glslVersion: GLSL3, vertexShader, fragmentShader, side: DoubleSide };

const geometryOf = (places) => new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3));

/** numbers: what the mask calls each triangle. */
function numberedGeometry({ places, numbers }) {
    const ofVertices = Uint32Array.from({ length: 3 * numbers.length }, (_, v) => numbers[Math.floor(v / 3)]);
    return geometryOf(places).setAttribute('number', new BufferAttribute(ofVertices, 1));
}

export class Triangles {
    constructor(stage) {
        this.stage = stage;
        const colour = () => ({ value: new Color() });
        this.uniforms = {
            mask: { value: null },
            inside: { value: null },
            unlike: { value: null },
            mark_size: { value: 12 },
            pixel_ratio: { value: 1 },
            missed_colour: colour(),
            straddling_colour: colour(),
            inside_colour: colour(),
            unlike_colour: colour(),
        };
        this.whole = new ShaderMaterial({ ...surface, uniforms: this.uniforms });
        this.numbered = new ShaderMaterial({ ...surface, uniforms: this.uniforms, defines: { IS_NUMBERED: 1 } });
        this.behind = this.numbered.clone();
        Object.assign(this.behind, { uniforms: this.uniforms, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
        this.mesh = new Mesh(new BufferGeometry(), this.whole);
        this.sample = new Mesh(new BufferGeometry(), this.behind);
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
            }),
        );
        for (const drawn of [this.mesh, this.sample, this.marks]) drawn.frustumCulled = false;
        this.marks.renderOrder = 3;
        stage.scene.add(this.mesh, this.sample, this.marks);
        stage.beforeDraw.push(() => {
            const ratio = (this.uniforms.pixel_ratio.value = stage.renderer.getPixelRatio());
            this.uniforms.mark_size.value = 12 * ratio;
        });
    }

    set visible(isVisible) {
        this.mesh.visible = isVisible;
        this.sample.visible = isVisible && !this.isWhole;
    }

    /** sample: what is drawn besides those that straddle; null where all are. */
    show({ places, sample }) {
        this.count = places.length / 9;
        this.isWhole = !sample;
        for (const drawn of [this.mesh, this.sample]) drawn.geometry.dispose();
        this.mesh.material = sample ? this.numbered : this.whole;
        if (sample) this.sample.geometry = numberedGeometry(sample);
        else this.mesh.geometry = geometryOf(places);
        this.room = sample?.numbers.length;
        for (const name of ['mask', 'inside', 'unlike']) {
            this[name]?.dispose();
            this[name] = new BitTexture(this.count);
            this.uniforms[name].value = this[name].texture;
        }
        this.places = places;
        this.visible = this.mesh.visible;
        this.mark([]);
    }

    /** The triangles are these, as many as before. */
    move(places) {
        this.places = places;
        this.mesh.geometry.getAttribute('position').set(places).needsUpdate = true;
        this.stage.draw();
    }

    /** Of a mesh that is not drawn whole: as many as there is room for. */
    drawStraddling(mask, inside) {
        const onBorder = mask.map((word, w) => word & ~inside[w]), numbers = Uint32Array.from(listBits(onBorder, this.room)),
            places = new Float32Array(9 * numbers.length);
        numbers.forEach((n, i) => places.set(this.places.subarray(9 * n, 9 * n + 9), 9 * i));
        this.mesh.geometry.dispose();
        this.mesh.geometry = numberedGeometry({ places, numbers });
    }

    classify({ mask, inside, unlike }) {
        this.mask.set(mask);
        this.inside.set(inside);
        if (unlike || this.hasUnlike) this.unlike.set(unlike);
        this.hasUnlike = Boolean(unlike);
        if (!this.isWhole) this.drawStraddling(mask, inside);
        this.stage.draw();
    }

    /** Rings around the middles of these triangles. */
    mark(numbers) {
        const shown = numbers.slice(0, MOST_MARKS), middles = new Float32Array(3 * shown.length);
        shown.forEach((n, m) => {
            for (let a = 0; a < 3; a++)
                middles[3 * m + a] = (this.places[9 * n + a] + this.places[9 * n + 3 + a] + this.places[9 * n + 6 + a]) / 3;
        });
        this.marks.geometry.dispose();
        this.marks.geometry = geometryOf(middles);
        this.marks.visible = shown.length > 0 && this.count > LARGE;
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

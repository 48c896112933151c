// tribox.d.ts - the types of the package tribox, and its manual: which of many triangles overlap a box, or the cells of a grid.
/// <reference lib="esnext.disposable" />

/**
 * Where tribox.wasm comes from: an address, a response, its bytes, or a module that is compiled already (which can be posted to
 * Workers). Without one it is looked for beside tribox.mjs. Where there is no page, as in Node.js, addresses are whole ones: a
 * file: URL, and not a path.
 */
export type Source = string | URL | Response | PromiseLike<Response> | BufferSource | WebAssembly.Module;

/** Compiles and starts an instance, with a memory of its own. Some milliseconds. */
export function load(source?: Source): Promise<Tribox>;

/** Three numbers, x, y and z: an array or an object such as three.js's Vector3. */
export type Vector = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number };

/**
 * A closed axis-aligned box, with lo and hi or, as three.js's Box3 has it, min and max. Its numbers are rounded to the nearest
 * float, and have to be finite; lo > hi on any axis makes it the empty box, which nothing overlaps.
 */
export type Box = { readonly lo: Vector; readonly hi: Vector } | { readonly min: Vector; readonly max: Vector };

/**
 * A closed oriented box: the points p with |axis[k] . (p - center)| <= half[k] for k = 0, 1, 2. The formula holds for whatever
 * floats are given; axes need not be orthonormal.
 */
export interface OrientedBox {
    readonly center: Vector;
    readonly half: Vector;
    readonly axis: readonly [Vector, Vector, Vector];
}

/**
 * exact: the true answer for every finite float. conservative: never misses an overlap, may report a triangle that misses the box
 * within rounding of contact. fast: single precision, errs either way within rounding of contact.
 */
export type Accuracy = 'exact' | 'conservative' | 'fast';

/** The paper's groups of axes: 3 box normals, the triangle's plane, 9 cross products of edges. With some left out more is reported. */
export type Axes = 'box' | 'plane' | 'edges';

export interface Options {
    /** 'exact' by default. */
    readonly accuracy?: Accuracy;
    /** All three groups by default. */
    readonly axes?: readonly Axes[];
    /** In which order the groups are tried (1 box, 2 plane, 3 edges). By default the call finds the best; it changes no answer. */
    readonly order?: 123 | 132 | 213 | 231 | 312 | 321;
}

export interface OverlapOptions extends Options {
    /** A mask of tribox.mask(soup.length) to write, in place of a new one: it is neither copied nor allocated. */
    readonly into?: Mask;
}

export interface ClassifyOptions extends OverlapOptions {
    /** The same for insideMask. */
    readonly insideInto?: Mask;
}

export interface VoxelizeOptions extends Options {
    /** Voxels of tribox.voxels(grid) to add to, in place of new ones: bits are only set, so soups accumulate. */
    readonly into?: Voxels;
}

export interface Overlap {
    /** How many triangles overlap the box. */
    readonly overlapping: number;
    /** Pairs left to a slower stage: a measure of cost. */
    readonly undecided: number;
    /** Bit i is set if triangle i overlaps. */
    readonly mask: Mask;
}

export interface Classes extends Overlap {
    /** How many triangles lie wholly inside the box. They overlap it, too; the others that do straddle its border. */
    readonly inside: number;
    /** Bit i is set if triangle i lies wholly inside. */
    readonly insideMask: Mask;
}

/** What lies in the memory of the instance until it is freed. `using` frees it at the end of a block. */
export interface Freeable {
    /** Gives the memory back. Whatever is done with the object afterwards throws; to free it again does nothing. */
    free(): void;
    [Symbol.dispose](): void;
}

/** An instance of the library. All that lies in its memory goes with it when it is garbage. */
export interface Tribox {
    /** Of the library, as '0.1.0'. */
    readonly version: string;
    /** The name of the kernel: 'wasm128'. */
    readonly kernel: string;
    /** To be posted to Workers, for load() there. */
    readonly module: WebAssembly.Module;
    readonly memory: WebAssembly.Memory;
    /** The functions of the library in C, whose names tribox.h explains, with malloc and free. */
    readonly exports: Readonly<Record<string, (...args: number[]) => number>>;

    /** Copies the triangles of a mesh into the memory, as nine streams. */
    soup(mesh: MeshOfFloats, options?: SoupOptions): Soup;
    /** Room for so many triangles, to be written through x, y and z. Until then they are NaN, and overlap nothing. */
    allocSoup(length: number): Soup;
    /** Copies a mesh of doubles, or of floats, into the memory as it is. Answers are exact about the doubles. */
    mesh(mesh: MeshOfNumbers): Mesh;
    /** A mask of so many bits in the memory, all clear, for `into`. */
    mask(length: number): Mask;
    /** The cells of a grid in the memory, all clear, for `into`. */
    voxels(grid: Grid): Voxels;
}

/**
 * positions: x, y, z of vertex after vertex. indices: three vertices a triangle; without them vertices 3 i, 3 i + 1 and 3 i + 2 are
 * triangle i. As three.js has them: geometry.attributes.position.array and geometry.index.array.
 * Views of the memory of the instance serve, too, such as the positions of a Mesh.
 */
export interface MeshOfFloats {
    readonly positions: Float32Array;
    readonly indices?: Uint32Array | Uint16Array | null;
}

export interface MeshOfNumbers {
    readonly positions: Float64Array | Float32Array;
    readonly indices?: Uint32Array | Uint16Array | null;
}

export interface SoupOptions {
    /**
     * Puts triangles that are near in space near in number, as an index wants them. All numbers of triangles are then about that
     * order; `ids` translates them.
     */
    readonly sort?: boolean;
}

/** Triangles in the memory: nine streams of floats. A triangle with a NaN or infinite coordinate overlaps nothing. */
export interface Soup extends Freeable {
    /** How many triangles there are. */
    readonly length: number;
    /**
     * x[v][i] is the x of vertex v (0, 1, 2) of triangle i: views of the memory, without a copy. They die when the memory grows,
     * which may be caused by whatever makes something (soup, allocSoup, mesh, mask, voxels, index), by Index.list, and by calls
     * that return masks or voxels without `into`. So do not keep them: each look at the property makes new ones.
     */
    readonly x: readonly [Float32Array, Float32Array, Float32Array];
    readonly y: readonly [Float32Array, Float32Array, Float32Array];
    readonly z: readonly [Float32Array, Float32Array, Float32Array];
    /** ids[i]: which triangle of the mesh triangle i was, if the soup was sorted. */
    readonly ids: Uint32Array | null;
    /** Where the tribox_soup of C lies in the memory, for functions of `exports`. */
    readonly address: number;

    /** Which triangles overlap the box? An oriented box is exact with all axes, or with 'box' alone. */
    overlap(box: Box | OrientedBox, options?: OverlapOptions): Overlap;
    /** How many do? */
    count(box: Box | OrientedBox, options?: Options): number;
    /** Which of them straddle the border of the box, and which lie wholly inside? */
    classify(box: Box, options?: ClassifyOptions): Classes;
    /** The first triangle that overlaps the box; -1 if none does. */
    first(box: Box, options?: Options): number;
    /** The first triangle that does not overlap the box; -1 if all do. */
    firstMiss(box: Box, options?: Options): number;
    /** The cells that triangles overlap: of a grid, or of one around the triangles. Insides of closed meshes are not filled. */
    voxelize(grid: Grid | Resolution, options?: VoxelizeOptions): Voxels;
    /** Bounds of groups of triangles, which make questions cost what their answer does. Freed by itself, before the soup. */
    index(): Index;
    /** The bounds of all triangles whose coordinates are finite; null if there are none. */
    bounds(): { lo: [number, number, number]; hi: [number, number, number] } | null;
}

/**
 * An index over a soup: the same answers, sooner. It pays where triangles near in number are near in space: see SoupOptions. The
 * soup alone has first and firstMiss; any says sooner whether some triangle overlaps.
 */
export interface Index extends Freeable {
    readonly soup: Soup;
    overlap(box: Box | OrientedBox, options?: OverlapOptions): Overlap;
    count(box: Box | OrientedBox, options?: Options): number;
    classify(box: Box, options?: ClassifyOptions): Classes;
    /** The triangles that overlap, in ascending order. With ids: their numbers in the mesh, if the soup was sorted. */
    list(box: Box | OrientedBox, options?: Options & { readonly ids?: boolean }): Uint32Array;
    /** Some triangle that overlaps; -1 if none does. */
    any(box: Box, options?: Options): number;
    /** To be called after triangles first .. first + count - 1 of the soup have changed; all of them by default. */
    update(first?: number, count?: number): void;
}

/** A mesh in the memory as it was given. The numbers of boxes are doubles here, and not rounded. */
export interface Mesh extends Freeable {
    readonly length: number;
    /** A view of the memory: see Soup. */
    readonly positions: Float64Array | Float32Array;
    /** Where the tribox_mesh of C lies in the memory, for functions of `exports`. */
    readonly address: number;
    overlap(box: Box, options?: OverlapOptions): Overlap;
    count(box: Box, options?: Options): number;
    classify(box: Box, options?: ClassifyOptions): Classes;
    first(box: Box, options?: Options): number;
    firstMiss(box: Box, options?: Options): number;
}

/**
 * A bit for each triangle. The mask of a call without `into` is the caller's own and needs no care. That of tribox.mask() lies in
 * the memory of the instance: its words are a view (see Soup), and free() gives them back.
 */
export interface Mask extends Freeable {
    readonly length: number;
    /** Bit i % 32 of words[i >> 5] is that of triangle i: an even number of words, and zeros past the last triangle. */
    readonly words: Uint32Array;
    has(i: number): boolean;
    /** How many bits are set. */
    count(): number;
    /** Which bits are set, in ascending order. */
    list(): Uint32Array;
}

/** size[0] x size[1] x size[2] cells. Plane p of axis a lies at the float nearest to origin[a] + p * cell[a]. */
export interface Grid {
    readonly origin: Vector;
    /** The lengths of a cell, or one for all three. */
    readonly cell: Vector | number;
    readonly size: Vector;
}

/** A grid of cubes that just holds the triangles, so many along their longest side. */
export interface Resolution {
    readonly resolution: number;
}

/** A bit for each cell; otherwise as Mask. */
export interface Voxels extends Freeable {
    /** As rounded to floats. */
    readonly origin: readonly [number, number, number];
    readonly cell: readonly [number, number, number];
    readonly size: readonly [number, number, number];
    /** The 32-bit words of a row of cells along x: an even number. */
    readonly rowWords: number;
    /** Cell (i, j, k) is bit i % 32 of bits[(k * size[1] + j) * rowWords + (i >> 5)]. */
    readonly bits: Uint32Array;
    has(i: number, j: number, k: number): boolean;
    /** How many cells are set. */
    count(): number;
    /** The cells that are set: i, j, k of one after another, by k, then j, then i. */
    list(): Uint32Array;
    /** The box of a cell: the very one that was tested. */
    box(i: number, j: number, k: number): { lo: [number, number, number]; hi: [number, number, number] };
}

/** What is wrong and is neither a wrong type (TypeError) nor a wrong value (RangeError): out of memory, freed, no SIMD. */
export class TriboxError extends Error {}

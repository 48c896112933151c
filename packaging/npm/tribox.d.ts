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
 * A closed axis-aligned box, with lo and hi or, as three.js's Box3 has it, min and max. Its numbers are the doubles that they are,
 * and have to be finite; lo > hi on any axis makes it the empty box, which nothing overlaps.
 */
export type Box = { readonly lo: Vector; readonly hi: Vector } | { readonly min: Vector; readonly max: Vector };

/**
 * A closed oriented box: the points p with |axis[k] . (p - center)| <= half[k] for k = 0, 1, 2. The formula holds for whatever
 * doubles are given; axes need not be orthonormal.
 */
export interface OrientedBox {
    readonly center: Vector;
    readonly half: Vector;
    readonly axis: readonly [Vector, Vector, Vector];
}

/**
 * exact: the true answer for every finite number. conservative: never misses an overlap, may report a triangle that misses the box
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
    readonly axisOrder?: 123 | 132 | 213 | 231 | 312 | 321;
}

export interface OverlapOptions extends Options {
    /** A mask of tribox.mask(length) to write, in place of a new one: it is neither copied nor allocated. */
    readonly into?: Mask;
}

export interface ClassifyOptions extends OverlapOptions {
    /** The same for insideMask. */
    readonly insideInto?: Mask;
}

export interface FindOptions extends Options {
    /** The first triangle that overlaps ('hit', the default), or the first that does not ('miss'). */
    readonly what?: 'hit' | 'miss';
}

export interface VoxelizeOptions extends Options {
    /** The cells that are asked for; by default the whole grid. */
    readonly window?: Window;
    /** Voxels of tribox.voxels(grid, window) to add to, in place of new ones: bits are only set, so soups accumulate. */
    readonly into?: Voxels;
    /** Also says which triangle: see Voxels.ids. Not with `into`. */
    readonly ids?: boolean;
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
    /** Of the library, as '1.0.0'. */
    readonly version: string;
    /** The name of the kernel: 'wasm128'. */
    readonly kernel: string;
    /** To be posted to Workers, for load() there. */
    readonly module: WebAssembly.Module;
    readonly memory: WebAssembly.Memory;
    /** The functions of the library in C, whose names tribox.h explains, with malloc and free. */
    readonly exports: Readonly<Record<string, (...args: number[]) => number>>;

    /** Copies the triangles of a mesh into the memory, as nine streams. */
    soup(mesh: MeshOfFloats, options?: SortOptions): Soup;
    /** Room for so many triangles, to be written through x, y and z. Until then they are NaN, and overlap nothing. */
    allocSoup(length: number): Soup;
    /** Copies a mesh of doubles, or of floats, into the memory as it is. Answers are exact about the doubles. */
    mesh(mesh: MeshOfNumbers, options?: SortOptions): Mesh;
    /** A mask of so many bits in the memory, all clear, for `into`. */
    mask(length: number): Mask;
    /** The cells of a grid, or of a window of it, in the memory, all clear, for `into`. */
    voxels(grid: Grid, window?: Window): Voxels;
    /** How many tiles of so many cells a side a grid of this size has. */
    tileCount(size: Vector, side: number): number;
    /** The grid that voxelize lays around triangles with these bounds. */
    gridAround(box: Box, cells: Around): Grid;
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

export interface SortOptions {
    /**
     * Puts triangles that are near in space near in number, as an index wants them. All numbers of triangles are then about that
     * order; `ids` translates them.
     */
    readonly sort?: boolean;
}

/** What soups and meshes have in common. A triangle with a NaN or infinite coordinate overlaps nothing. */
export interface Triangles extends Freeable {
    /** How many triangles there are. */
    readonly length: number;
    /** ids[i]: which triangle of the mesh triangle i was, if they were sorted. */
    readonly ids: Uint32Array | null;
    /** Where the tribox_soup or tribox_mesh of C lies in the memory, for functions of `exports`. */
    readonly address: number;

    /** Which triangles overlap the box? An oriented box is exact with all axes, or with 'box' alone. */
    overlap(box: Box | OrientedBox, options?: OverlapOptions): Overlap;
    /** How many do? */
    count(box: Box | OrientedBox, options?: Options): number;
    /** Which of them straddle the border of the box, and which lie wholly inside? */
    classify(box: Box, options?: ClassifyOptions): Classes;
    /** The first triangle that overlaps the box, or that does not; -1 if there is none. */
    find(box: Box, options?: FindOptions): number;
    /** Bounds of groups of triangles, which make questions cost what their answer does. Freed by itself, before the triangles. */
    index(): Index;
    /** The bounds of all triangles whose coordinates are finite; null if there are none. */
    bounds(): { lo: [number, number, number]; hi: [number, number, number] } | null;

    /** The cells that triangles overlap: of a grid, or of one around them. Voxels stand for their own grid and window. */
    voxelize(grid: Grid | Around | Voxels, options?: VoxelizeOptions): Voxels;
    /**
     * The cells that a closed surface encloses, and its own: along x it crosses the line to their middles an odd number of times.
     * voxels: what voxelize made of these triangles, of a whole grid. See also Voxels.fillOutside.
     */
    fillParity(voxels: Voxels): FilledByParity;
    /** Which triangles overlap which tile of a grid: with a side of 1, which cell. */
    tileLists(grid: Grid | Around, tiles: Tiles, options?: Options): TileLists;
    /** All triangles of each cell that has any, of a grid or of a window of it; memory for each cell of the window. */
    cellLists(grid: Grid | Around | Voxels, options?: CellListsOptions): CellLists;
    /**
     * voxelize for grids whose cells need not fit into the memory: hands each brick of 8 x 8 x 8 cells that is not empty to take,
     * by the number of its tile, then by z, y, x. tiles: their side is a multiple of 8, at most 1024; 128 suits.
     */
    bricks(grid: Grid | Around, tiles: Tiles, take: TakeBrick, options?: Options): Bricks;
}

/** Triangles in the memory: nine streams of floats. */
export interface Soup extends Triangles {
    /**
     * x[v][i] is the x of vertex v (0, 1, 2) of triangle i: views of the memory, without a copy. They die when the memory grows,
     * which may be caused by whatever makes something (soup, allocSoup, mesh, mask, voxels, index), by lists, bricks and fills, and
     * by calls that return masks or voxels without `into`. So do not keep them: each look at the property makes new ones.
     */
    readonly x: readonly [Float32Array, Float32Array, Float32Array];
    readonly y: readonly [Float32Array, Float32Array, Float32Array];
    readonly z: readonly [Float32Array, Float32Array, Float32Array];
}

/** A mesh in the memory as it was given. */
export interface Mesh extends Triangles {
    /** Views of the memory: see Soup. If the mesh was sorted, so are the indices, or without them the positions. */
    readonly positions: Float64Array | Float32Array;
    readonly indices: Uint32Array | Uint16Array | null;
}

/**
 * An index over a soup or a mesh: the same answers, sooner, and of doubles about the doubles. It pays where triangles near in
 * number are near in space: see SortOptions. For find, ask the triangles; any says sooner whether some triangle overlaps.
 */
export interface Index extends Freeable {
    readonly triangles: Soup | Mesh;
    overlap(box: Box | OrientedBox, options?: OverlapOptions): Overlap;
    count(box: Box | OrientedBox, options?: Options): number;
    classify(box: Box, options?: ClassifyOptions): Classes;
    /** The triangles that overlap, in ascending order. With ids: their numbers in the mesh, if it was sorted. */
    list(box: Box | OrientedBox, options?: Options & { readonly ids?: boolean }): Uint32Array;
    /** list() for box after box. */
    lists(boxes: readonly (Box | OrientedBox)[], options?: Options & { readonly ids?: boolean }): Lists;
    /** Some triangle that overlaps; -1 if none does. */
    any(box: Box | OrientedBox, options?: Options): number;
    /** To be called after triangles first .. first + count - 1 have changed; all of them by default. */
    update(first?: number, count?: number): void;
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

/** size[0] x size[1] x size[2] cells. Plane p of axis a lies at the double nearest to origin[a] + p * cell[a]. */
export interface Grid {
    readonly origin: Vector;
    /** The lengths of a cell, or one for all three. */
    readonly cell: Vector | number;
    readonly size: Vector;
}

/** A grid that just holds the triangles: of cubes, so many along their longest side, or of cells of a length, or of three. */
export type Around = { readonly resolution: number } | { readonly cell: Vector | number };

/** Cells first[a] .. first[a] + size[a] - 1 of a grid, on each axis. */
export interface Window {
    readonly first: Vector;
    readonly size: Vector;
}

/**
 * Tiles are cubes of `side` cells a side, but for those that the upper borders of the grid cut. Tile (i, j, k) has the number
 * (k * nj + j) * ni + i, where ni and nj are the numbers of tiles along x and y. first, count: a share of them; by default all.
 */
export interface Tiles {
    readonly side: number;
    readonly first?: number;
    readonly count?: number;
}

export interface CellListsOptions extends Options {
    /** The cells that are asked for; by default the whole grid. */
    readonly window?: Window;
}

export interface Lists {
    /** The triangles of number n are list[starts[n]] to before list[starts[n + 1]]. */
    readonly starts: Uint32Array;
    readonly list: Uint32Array;
}

/** Cell n has one triangle or more, in ascending order. At 'exact' the cells are those of voxelize. */
export interface CellLists extends Lists {
    readonly grid: Grid;
    readonly window: Window;
    /** i, j, k of one cell after another, as Voxels.list() has them. */
    readonly cells: Uint32Array;
}

export interface TileLists {
    readonly grid: Grid;
    /** The triangles of tile first + t are list[starts[t]] to before list[starts[t + 1]], in ascending order. */
    readonly starts: Uint32Array;
    readonly list: Uint32Array;
}

/**
 * Brick at[0], at[1], at[2] has the cells 8 * at[a] + 0 .. 7. Cell (i, j, k) of it is bit i + 8 * (j & 3) of the 32-bit word
 * bits[2 * k + (j >> 2)]. Both are the caller's own. To return false ends the call; what is thrown, too, and is thrown on.
 */
export type TakeBrick = (at: [number, number, number], bits: Uint32Array) => unknown;

export interface Bricks {
    readonly grid: Grid;
    /** How many cells the bricks that were handed on have set. */
    readonly overlapping: number;
    /** Whether take ended the call. */
    readonly stopped: boolean;
}

export interface Filled {
    /** The cells of the surface and those that it encloses. */
    readonly solid: Voxels;
    /** How many were filled, without those of the surface. */
    readonly inside: number;
}

export interface FilledByParity extends Filled {
    /** How many rows of cells along x the surface crosses an odd number of times: one or more, and it is certainly not closed. */
    readonly oddRows: number;
}

/** A bit for each cell; otherwise as Mask. */
export interface Voxels extends Freeable {
    readonly grid: Grid;
    /** Which cells of the grid these are: cell (i, j, k) here is cell (first[0] + i, first[1] + j, first[2] + k) there. */
    readonly window: Window;
    /** Of the window. */
    readonly size: readonly [number, number, number];
    /** The 32-bit words of a row of cells along x: an even number. */
    readonly rowWords: number;
    /** Cell (i, j, k) is bit i % 32 of bits[(k * size[1] + j) * rowWords + (i >> 5)]. */
    readonly bits: Uint32Array;
    /**
     * For each cell, (i, j, k) at (k * size[1] + j) * size[0] + i, the lowest number of a triangle that overlaps it, or 2^32 - 1 where
     * it is not set; null where voxelize was not asked for ids. Colours of cells are then one look-up. The caller's own.
     */
    readonly ids: Uint32Array | null;
    has(i: number, j: number, k: number): boolean;
    /** How many cells are set. */
    count(): number;
    /** The cells that are set: i, j, k of one after another, by k, then j, then i. */
    list(): Uint32Array;
    /** What the surface encloses: all cells that cannot be reached from outside through faces of cells that are not set. */
    fillOutside(): Filled;
    /** The box of a cell: the very one that was tested. */
    box(i: number, j: number, k: number): { lo: [number, number, number]; hi: [number, number, number] };
}

/** What is wrong and is neither a wrong type (TypeError) nor a wrong value (RangeError): out of memory, freed, no SIMD. */
export class TriboxError extends Error {}

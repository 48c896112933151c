// tribox.d.ts - the types of the package tribox, and its manual: which of many triangles overlap a box, or the cells of a grid.
/// <reference lib="esnext.disposable" />

/**
 * Where tribox.wasm comes from: an address, a response, its bytes, or a compiled module (which can be posted to Workers). By
 * default it is loaded from the folder of tribox.mjs. If there is no page, as in Node.js, addresses must be complete: a file: URL,
 * not a path.
 */
export type Source = string | URL | Response | PromiseLike<Response> | BufferSource | WebAssembly.Module;

/** Compiles and starts an instance, with a memory of its own. Takes some milliseconds. */
export function load(source?: Source): Promise<Tribox>;

/** Three numbers, x, y and z: an array or an object such as three.js's Vector3. */
export type Vector = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number };

/**
 * A closed axis-aligned box, with lo and hi or, as in three.js's Box3, min and max. Its numbers are taken as doubles, without
 * rounding, and must be finite. If lo > hi on any axis, the box is empty, and nothing overlaps it.
 */
export type Box = { readonly lo: Vector; readonly hi: Vector } | { readonly min: Vector; readonly max: Vector };

/**
 * A closed oriented box: the points p with |axis[k] . (p - center)| <= half[k] for k = 0, 1, 2. The formula is taken literally for
 * the doubles given; axes need not be orthonormal.
 */
export interface OrientedBox {
    readonly center: Vector;
    readonly half: Vector;
    readonly axis: readonly [Vector, Vector, Vector];
}

/**
 * exact: the true answer for every finite number. conservative: never misses an overlap, but may report a triangle that misses the
 * box within rounding of contact. fast: single precision; may err either way within rounding of contact.
 */
export type Accuracy = 'exact' | 'conservative' | 'fast';

/** The paper's groups of axes: 3 box normals, the triangle's plane, 9 cross products of edges. Fewer groups report more. */
export type Axes = 'box' | 'plane' | 'edges';

export interface Options {
    /** 'exact' by default. */
    readonly accuracy?: Accuracy;
    /** All three groups by default. */
    readonly axes?: readonly Axes[];
    /** The order in which groups are tried (1 box, 2 plane, 3 edges). By default the call chooses; the order changes no answer. */
    readonly axisOrder?: 123 | 132 | 213 | 231 | 312 | 321;
}

export interface OverlapOptions extends Options {
    /** A mask made by tribox.mask(length) to write to; without it the call allocates and copies a new one. */
    readonly into?: Mask;
}

export interface ClassifyOptions extends OverlapOptions {
    /** As `into`, for insideMask. */
    readonly insideInto?: Mask;
}

export interface FindOptions extends Options {
    /** The first triangle that overlaps ('hit', the default), or the first that does not ('miss'). */
    readonly what?: 'hit' | 'miss';
}

export interface SplitOptions extends Options {
    /** Where the children meet, not outside the box; by default the doubles nearest to (lo + hi) / 2. */
    readonly middle?: Vector;
    /** The triangles that are tested, in any order, some perhaps more than once; by default all. */
    readonly list?: ArrayLike<number>;
}

export interface VoxelizeOptions extends Options {
    /** The cells that are wanted; by default the whole grid. */
    readonly window?: Window;
    /** Voxels made by tribox.voxels(grid, window) to add to: bits are only set, so soups accumulate. */
    readonly into?: Voxels;
    /** Also says which triangle: see Voxels.ids. Not with `into`. */
    readonly ids?: boolean;
    /** About half of these cells: a flat surface is a cell thick, and closed across faces. Exact, of all axes. Not with `ids`. */
    readonly thin?: boolean;
}

export interface Overlap {
    /** How many triangles overlap the box. */
    readonly overlapping: number;
    /** Pairs that a slower stage decided: a measure of cost. */
    readonly undecided: number;
    /** Bit i is set if triangle i overlaps. */
    readonly mask: Mask;
}

export interface Classes extends Overlap {
    /** How many triangles lie wholly inside the box. They overlap it, too; all others that overlap straddle its border. */
    readonly inside: number;
    /** Bit i is set if triangle i lies wholly inside. */
    readonly insideMask: Mask;
}

/** An object in the memory of the instance until it is freed. `using` frees it at the end of a block. */
export interface Freeable {
    /** Gives the memory back. Any use of the object afterwards throws; freeing it again does nothing. */
    free(): void;
    [Symbol.dispose](): void;
}

/** An instance of the library. Everything in its memory goes when the instance is garbage-collected. */
export interface Tribox {
    /** The version of the library, such as '1.0.0'. */
    readonly version: string;
    /** The name of the kernel: 'wasm128'. */
    readonly kernel: string;
    /** Give it to load() in Workers: it can be posted. */
    readonly module: WebAssembly.Module;
    readonly memory: WebAssembly.Memory;
    /** The C functions of the library, which tribox.h explains, with malloc and free. */
    readonly exports: Readonly<Record<string, (...args: number[]) => number>>;

    /** Copies the triangles of a mesh into the memory, as nine streams. */
    soup(mesh: MeshOfFloats, options?: SortOptions): Soup;
    /** Space for `length` triangles, which you write through x, y and z. Until then they are NaN, and overlap nothing. */
    allocSoup(length: number): Soup;
    /** Copies a mesh of doubles, or of floats, into the memory as it is. Answers are exact about the doubles. */
    mesh(mesh: MeshOfNumbers, options?: SortOptions): Mesh;
    /** A mask of `length` bits in the memory, all clear, for `into`. */
    mask(length: number): Mask;
    /** The cells of a grid, or of a window of it, in the memory, all clear, for `into`. */
    voxels(grid: Grid, window?: Window): Voxels;
    /** How many tiles a grid of this size has, with `side` cells along each side of a tile. */
    tileCount(size: Vector, side: number): number;
    /** The grid that voxelize lays around triangles with these bounds. */
    gridAround(box: Box, cells: Around): Grid;
}

/**
 * positions: x, y, z of vertex after vertex. indices: three vertices a triangle; without them vertices 3 i, 3 i + 1 and 3 i + 2 are
 * triangle i. In three.js they are geometry.attributes.position.array and geometry.index.array.
 * Views of the memory of the instance are allowed, such as the positions of a Mesh.
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
     * Gives near numbers to triangles that are near in space, which makes an index fast. All triangle numbers then refer to that
     * order; `ids` translates them.
     */
    readonly sort?: boolean;
}

/** What soups and meshes have in common. A triangle with a NaN or infinite coordinate overlaps nothing. */
export interface Triangles extends Freeable {
    /** How many triangles there are. */
    readonly length: number;
    /** ids[i]: the number that triangle i had in the mesh before sorting; null if not sorted. */
    readonly ids: Uint32Array | null;
    /** Where the tribox_soup or tribox_mesh of C lies in the memory, for functions of `exports`. */
    readonly address: number;

    /** Which triangles overlap the box? An oriented box is exact with all axes, or with 'box' alone. */
    overlap(box: Box | OrientedBox, options?: OverlapOptions): Overlap;
    /** How many triangles overlap the box? */
    count(box: Box | OrientedBox, options?: Options): number;
    /** Which of them straddle the border of the box, and which lie wholly inside? */
    classify(box: Box, options?: ClassifyOptions): Classes;
    /** The first triangle that overlaps the box, or that does not; -1 if there is none. */
    find(box: Box, options?: FindOptions): number;
    /**
     * Which of the eight children of a box does each triangle overlap? For octrees: bit c of a byte is child c, from lo to the
     * middle on axis a if bit a of c is 0, from there to hi if it is 1. Axes are all, or 'box'. If all leaves have one size,
     * bricks() is many times as fast.
     */
    split(box: Box, options?: SplitOptions): Uint8Array;
    /** An index: bounds of groups of triangles, so the time of a query grows only with its answer. Free it before the triangles. */
    index(): Index;
    /** The bounds of all triangles whose coordinates are finite; null if there are none. */
    bounds(): { lo: [number, number, number]; hi: [number, number, number] } | null;

    /** The cells that triangles overlap: of a grid, or of one laid around them. Voxels stand for their own grid and window. */
    voxelize(grid: Grid | Around | Voxels, options?: VoxelizeOptions): Voxels;
    /**
     * The cells of a closed surface and the cells that it encloses: it crosses the line along x to their middles an odd number of
     * times. voxels: from voxelize, of these triangles and a whole grid. See also Voxels.fillOutside.
     */
    fillParity(voxels: Voxels): FilledByParity;
    /** Which triangles overlap which tile of a grid, or with a side of 1 which cell. */
    tileLists(grid: Grid | Around, tiles: Tiles, options?: Options): TileLists;
    /** All triangles of each cell that has any, of a grid or of a window of it; takes memory for each cell of the window. */
    cellLists(grid: Grid | Around | Voxels, options?: CellListsOptions): CellLists;
    /**
     * voxelize for grids whose cells need not fit into the memory: calls take for each brick of 8 x 8 x 8 cells that is not empty,
     * in the order of tile numbers, then of z, y, x. tiles: their side is a multiple of 8, at most 1024. 128 is a good choice, or
     * 64 with lists, which take about 2 KB for each triangle of the fullest tile.
     */
    bricks(grid: Grid | Around, tiles: Tiles, take: TakeBrick, options?: Options & { readonly lists?: false }): Bricks;
    bricks(grid: Grid | Around, tiles: Tiles, take: TakeBrickLists, options: Options & { readonly lists: true }): Bricks;
}

/** Triangles in the memory: nine streams of floats. */
export interface Soup extends Triangles {
    /**
     * x[v][i] is the x of vertex v (0, 1, 2) of triangle i: views of the memory, without a copy. They become invalid when the
     * memory grows, which can happen in calls that make something (soup, allocSoup, mesh, mask, voxels, index), in lists, bricks
     * and fills, and in calls that return masks or voxels without `into`. So do not keep them: each access to the property makes
     * new views.
     */
    readonly x: readonly [Float32Array, Float32Array, Float32Array];
    readonly y: readonly [Float32Array, Float32Array, Float32Array];
    readonly z: readonly [Float32Array, Float32Array, Float32Array];
}

/** A mesh in the memory as it was given. */
export interface Mesh extends Triangles {
    /** Views of the memory: see Soup. In a sorted mesh the indices are in that order, or the positions if there are none. */
    readonly positions: Float64Array | Float32Array;
    readonly indices: Uint32Array | Uint16Array | null;
}

/**
 * An index over a soup or a mesh: the same answers, faster, and for doubles exact about the doubles. It pays if triangles with near
 * numbers are near in space: see SortOptions. It has no find: call find of the triangles, or any, which is faster.
 */
export interface Index extends Freeable {
    readonly triangles: Soup | Mesh;
    overlap(box: Box | OrientedBox, options?: OverlapOptions): Overlap;
    count(box: Box | OrientedBox, options?: Options): number;
    classify(box: Box, options?: ClassifyOptions): Classes;
    /** The triangles that overlap, in ascending order. With ids: their numbers in the mesh, if it was sorted. */
    list(box: Box | OrientedBox, options?: Options & { readonly ids?: boolean }): Uint32Array;
    /** list() for many boxes. */
    lists(boxes: readonly (Box | OrientedBox)[], options?: Options & { readonly ids?: boolean }): Lists;
    /** Any one triangle that overlaps; -1 if none does. */
    any(box: Box | OrientedBox, options?: Options): number;
    /** Call this after triangles first .. first + count - 1 have changed; by default all of them. */
    update(first?: number, count?: number): void;
}

/**
 * A bit for each triangle. A mask that a call without `into` returns is yours, and need not be freed. A mask made by tribox.mask()
 * lies in the memory of the instance: its words are a view (see Soup), and free() gives them back.
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

/** A grid that just holds the triangles: of `resolution` cubes along their longest side, or of cells of one length or three. */
export type Around = { readonly resolution: number } | { readonly cell: Vector | number };

/** Cells first[a] .. first[a] + size[a] - 1 of a grid, on each axis. */
export interface Window {
    readonly first: Vector;
    readonly size: Vector;
}

/**
 * Tiles are cubes of `side` cells a side, except those that the upper borders of the grid cut. Tile (i, j, k) has the number
 * (k * nj + j) * ni + i, where ni and nj are the numbers of tiles along x and y. first, count: a share of them; by default all.
 */
export interface Tiles {
    readonly side: number;
    readonly first?: number;
    readonly count?: number;
}

export interface CellListsOptions extends Options {
    /** The cells that are wanted; by default the whole grid. */
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
 * bits[2 * k + (j >> 2)]. Both arrays are yours to keep. Returning false ends the call; so does an exception, which is passed on.
 */
export type TakeBrick = (at: [number, number, number], bits: Uint32Array) => unknown;

/**
 * The same with the triangles of each cell: cell i, j, k has triangles[starts[c]] to before triangles[starts[c + 1]], where c is i
 * + 8 * j + 64 * k.
 */
export type TakeBrickLists =
    (at: [number, number, number], bits: Uint32Array, starts: Uint32Array, triangles: Uint32Array) => unknown;

export interface Bricks {
    readonly grid: Grid;
    /** How many cells are set in the bricks that take received. */
    readonly overlapping: number;
    /** Whether take ended the call. */
    readonly stopped: boolean;
}

export interface Filled {
    /** The cells of the surface and those that it encloses. */
    readonly solid: Voxels;
    /** How many cells were filled, without those of the surface. */
    readonly inside: number;
}

export interface FilledByParity extends Filled {
    /** How many rows of cells along x the surface crosses an odd number of times; if any, it is certainly not closed. */
    readonly oddRows: number;
}

/** A bit for each cell; otherwise as Mask. */
export interface Voxels extends Freeable {
    readonly grid: Grid;
    /** Which cells of the grid these are: cell (i, j, k) here is cell (first[0] + i, first[1] + j, first[2] + k) there. */
    readonly window: Window;
    /** The size of the window. */
    readonly size: readonly [number, number, number];
    /** The 32-bit words of a row of cells along x: an even number. */
    readonly rowWords: number;
    /** Cell (i, j, k) is bit i % 32 of bits[(k * size[1] + j) * rowWords + (i >> 5)]. */
    readonly bits: Uint32Array;
    /**
     * For each cell, (i, j, k) at (k * size[1] + j) * size[0] + i, the lowest number of a triangle that overlaps it, or 2^32 - 1 if
     * the cell is not set; null unless voxelize was called with ids. Look colours of cells up by it. The array is yours.
     */
    readonly ids: Uint32Array | null;
    has(i: number, j: number, k: number): boolean;
    /** How many cells are set. */
    count(): number;
    /** The set cells: i, j, k of one after another, ordered by k, then j, then i. */
    list(): Uint32Array;
    /** What the surface encloses: all cells that cannot be reached from outside across faces of clear cells. */
    fillOutside(): Filled;
    /** The box of a cell: the very one that was tested. */
    box(i: number, j: number, k: number): { lo: [number, number, number]; hi: [number, number, number] };
}

/** Errors other than a wrong type (TypeError) or a wrong value (RangeError): out of memory, already freed, no SIMD. */
export class TriboxError extends Error {}

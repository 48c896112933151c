/*
 * tribox_threads.h - longer jobs in steps, for threads that share them, and for grids larger than memory
 *
 * Spatial order: tribox_soup_sort, tribox_mesh_sort and tribox_boxes_sort consist of these steps: start everything, cut it once for
 * each thread, finish every part. Any number of threads may take part in a step; the order is the same as in one call.
 *
 * Tiles: tribox_tile_lists for a part of the triangles, into one list for all.
 *
 * Insides: parity is filled window by window. The outside is filled part by part, and labels of free cells are joined across the
 * faces of parts. Together the bits are the same as by tribox_fill_parity and tribox_fill_outside.
 */
#ifndef TRIBOX_THREADS_H
#define TRIBOX_THREADS_H

#include <tribox.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ============================================================================================================================== */
/*                                              Spatial order, step by step (threads)                                             */
/* ============================================================================================================================== */

/**
 * The first step of tribox_soup_sort: writes to scratch where triangles first .. first + count - 1 lie. After all of the soup is
 * done, tribox_sort_cut or tribox_sort_finish follows.
 *
 * scratch: all of it, as for tribox_soup_sort. Threads may start different parts of the soup.
 *
 * Returns what tribox_soup_sort does; TRIBOX_BAD_ARGUMENT also if first + count exceeds soup->count.
 */
TRIBOX_API tribox_status tribox_soup_sort_start(const tribox_soup *soup, size_t first, size_t count, void *scratch);

/** tribox_soup_sort_start for boxes. */
TRIBOX_API tribox_status tribox_boxes_sort_start(const tribox_boxes *boxes, size_t first, size_t count, void *scratch);

/** tribox_soup_sort_start for a mesh, of which only the indices of these triangles are checked. */
TRIBOX_API tribox_status tribox_mesh_sort_start(const tribox_mesh *mesh, size_t first, size_t count, void *scratch);

/**
 * Cuts one part of an order in two: places first .. first + count - 1, at first all places. Threads may take different parts.
 *
 * scratch: as the calls before left it.
 * total: the count of the soup, the boxes or the mesh.
 * before: receives how many places the first of the two parts has, from `first` on; 0 if count is 64 or less and nothing is cut.
 *
 * Returns TRIBOX_OK or TRIBOX_BAD_ARGUMENT (before is NULL; scratch is NULL and count > 0; or first + count exceeds total).
 */
TRIBOX_API tribox_status tribox_sort_cut(void *scratch, size_t total, size_t first, size_t count, size_t *before);

/**
 * The last step: makes all further cuts of a part and writes order[first] .. order[first + count - 1]. The order is the same as in
 * one call, however many parts are cut before they are finished. Threads may take different parts.
 *
 * scratch, total: as for tribox_sort_cut.
 * order: all of it, as for tribox_soup_sort.
 *
 * Returns TRIBOX_OK or TRIBOX_BAD_ARGUMENT (scratch or order is NULL and count > 0, or first + count exceeds total).
 */
TRIBOX_API tribox_status tribox_sort_finish(void *scratch, size_t total, size_t first, size_t count, uint32_t *order);

/* ============================================================================================================================== */
/*                                               Lists by tile, part by part (threads)                                            */
/* ============================================================================================================================== */

/**
 * tribox_tile_lists for triangles first .. first + count - 1 only, for threads that write one list together. It takes two passes
 * over the same parts. The first, without a list, counts each part. From the counts the caller works out the places: tile after
 * tile of the share, and for each tile part after part. The second pass, with the list, writes each part from its places on. The
 * list is the same as by tribox_tile_lists.
 *
 * first, count: within the soup, which has at most 2^32 triangles. The list has numbers of triangles in the soup.
 * places: tiles->count numbers, for this part. Without a list, written: how many of its triangles are in tile tiles->first + t.
 *   With a list, the place in it of the first of them; on return, the place after the last.
 * list: one for all parts, written only in these places; NULL to count.
 *
 * Returns what tribox_tile_lists does; TRIBOX_BAD_ARGUMENT also if first + count exceeds soup->count.
 */
TRIBOX_API tribox_status tribox_tile_lists_part(const tribox_soup *soup, size_t first, size_t count, const tribox_grid *grid,
                                                const tribox_tiles *tiles, const tribox_options *options, size_t *places,
                                                uint32_t *list);

/** tribox_tile_lists_part for a mesh, of floats or doubles, of which only the indices of these triangles are checked. */
TRIBOX_API tribox_status tribox_mesh_tile_lists_part(const tribox_mesh *mesh, size_t first, size_t count, const tribox_grid *grid,
                                                     const tribox_tiles *tiles, const tribox_options *options, size_t *places,
                                                     uint32_t *list);

/* ============================================================================================================================== */
/*                                                Insides, part by part (threads)                                                 */
/* ============================================================================================================================== */

/**
 * tribox_fill_parity for a window of the grid, with the bits of the whole. Windows are independent: threads may take some layers
 * each, and a grid larger than memory is filled by rows of tiles. Triangles whose extents on y and z miss the window make no
 * difference, so they may be left out. Triangles that lie before or after it on x are needed.
 *
 * window: the cells that are wanted; NULL for the whole grid.
 * occupied, solid: tribox_window_words(size) words each, size being that of the window, which may have 2^31 words.
 * scratch: tribox_fill_bytes(size) bytes for the size of the window, at any alignment.
 * inside: receives how many cells of the window were filled; NULL if not wanted.
 * odd_rows: receives how many rows of the window have an odd number of crossings in all, wherever on the row these are. Over
 *   windows of whole rows these add up to the number of the grid. NULL if not wanted.
 *
 * Returns what tribox_fill_parity does; TRIBOX_BAD_ARGUMENT also if the window leaves the grid.
 */
TRIBOX_API tribox_status tribox_fill_parity_window(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                                   const uint64_t *occupied, void *scratch, uint64_t *solid, size_t *inside,
                                                   size_t *odd_rows);

/** tribox_fill_parity_window for a mesh, of floats or doubles. Returns what it does, plus mesh errors as tribox_mesh_voxelize. */
TRIBOX_API tribox_status tribox_mesh_fill_parity_window(const tribox_mesh *mesh, const tribox_grid *grid,
                                                        const tribox_window *window, const uint64_t *occupied, void *scratch,
                                                        uint64_t *solid, size_t *inside, size_t *odd_rows);

/** In the faces of tribox_fill_labels: an occupied cell. */
#define TRIBOX_NO_LABEL UINT32_MAX

/** The bytes of scratch that tribox_fill_labels needs for a part of this size; SIZE_MAX if that is too large or overflows. */
TRIBOX_API size_t tribox_fill_labels_bytes(const uint32_t size[3]);

/**
 * The first step of tribox_fill_outside for a grid in parts, boxes of cells that share faces, such as tiles: labels the free cells
 * on the six faces of a part. Two have the same label if and only if they are connected across faces of free cells of the part. All
 * parts take this step, in any order and by any threads. Then tribox_fill_join joins them, and tribox_fill_labelled follows. Keep
 * the faces of a part until they are joined, and its count of labels until it is filled.
 *
 * size: of the part: (size[0] + 1) / 2 * size[1] * size[2] must be less than 2^31.
 * occupied: the words of the part, in the layout of a tribox_window.
 * scratch: tribox_fill_labels_bytes(size) bytes, at any alignment. tribox_fill_labelled needs its contents, which may be moved.
 * faces: labels 0 .. count - 1, and TRIBOX_NO_LABEL for occupied cells: faces[2 * a] of the first cells on axis a, faces[2 * a + 1]
 *   of the last. Cell (i, j, k) is number k * size[1] + j of the first two, k * size[0] + i of the next two, and j * size[0] + i of
 *   the last two. NULL for a face that is not wanted.
 * count: receives how many labels there are. Free cells that are not connected to a face have none.
 *
 * Returns TRIBOX_OK, TRIBOX_BAD_ARGUMENT (a NULL pointer) or TRIBOX_BAD_GRID (a size of 0, or a part that is too large).
 */
TRIBOX_API tribox_status tribox_fill_labels(const uint32_t size[3], const uint64_t *occupied, void *scratch,
                                            uint32_t *const faces[6], uint32_t *count);

/**
 * The second step: joins the labels of two parts across the face that they share. One thread at a time.
 *
 * parents: a forest of all labels of all parts, and one more label for the outside, say 0, with which you join faces at the border
 *   of the grid. At first parents[n] is n. The caller chooses the number of a part's first label.
 * a: a face of one part.
 * b: the same face of the other part, its cells in the same order; NULL if all its cells are free and have label 0: the outside, or
 *   a part without occupied cells, which needs only one label and no call of tribox_fill_labels.
 * from_a, from_b: the number in parents that label 0 of each part has.
 * count: cells of the face.
 *
 * Returns TRIBOX_OK or TRIBOX_BAD_ARGUMENT (parents or a is NULL and count > 0).
 */
TRIBOX_API tribox_status tribox_fill_join(uint32_t *parents, const uint32_t *a, uint32_t from_a, const uint32_t *b, uint32_t from_b,
                                          size_t count);

/** The one number that stands for all labels joined with `label`, including itself. It shortens the paths in parents. */
TRIBOX_API uint32_t tribox_fill_root(uint32_t *parents, uint32_t label);

/**
 * The last step: fills the cells of a part that the outside does not reach.
 *
 * size, occupied: of the part, as for tribox_fill_labels.
 * scratch: the bytes that tribox_fill_labels left for the same words, at any address; they are not changed.
 * outside: a mask with a bit for each label, set if it is joined with the outside.
 * solid: as many words as occupied, not overlapping it; written: the surface and its inside, with zeros past each row's last cell.
 * inside: receives how many cells were filled, not counting occupied ones; NULL if not wanted.
 *
 * Returns what tribox_fill_labels does.
 */
TRIBOX_API tribox_status tribox_fill_labelled(const uint32_t size[3], const uint64_t *occupied, void *scratch,
                                              const uint64_t *outside, uint64_t *solid, size_t *inside);

#ifdef __cplusplus
}
#endif

#endif

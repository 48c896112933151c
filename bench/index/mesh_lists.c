/* mesh_lists.c - welds a soup to meshes of floats and doubles, and asks indices over them. */
#include "mesh_lists.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "index_forms.h"
#include "timing/weld.h"

static const char *const names[MESH_LISTS] = {"soup", "boxes of doubles", "mesh of floats", "mesh of doubles"};

/* Vertices are numbered in the order of the file; then the triangles are put into theirs. Returns how many vertices there are. */
static size_t weld_in_order(const tribox_soup *file, const uint32_t *ids, mesh_lists *made)
{
    uint32_t(*const corners)[3] = malloc(file->count * sizeof *corners);
    const size_t vertices = corners ? weld_soup(file, made->floats, corners) : 0;
    for (size_t i = 0; vertices && i < file->count; i++)
        memcpy(made->indices + 3 * i, corners[ids[i]], sizeof corners[0]);
    free(corners);
    return vertices;
}

/* As if the mesh came from a map, or from another model: farther away than it is long, where floats would not tell it. */
static void move(mesh_lists *made, size_t vertices, double extent)
{
    const double by[3] = {700 * extent, -9000 * extent, 33 * extent};
    for (size_t v = 0; v < vertices; v++)
        for (int a = 0; a < 3; a++)
            made->doubles[v][a] = (double)made->floats[v][a] + by[a];
    for (size_t b = 0; b < made->count; b++)
        for (int a = 0; a < 3; a++) {
            const double lo = made->boxes[b].lo[a], hi = made->boxes[b].hi[a];
            made->moved[b].lo[a] = lo + by[a];
            made->moved[b].hi[a] = hi + by[a];
            made->wide[b].lo[a] = nextafter(lo, hi);
            made->wide[b].hi[a] = nextafter(hi, lo);
        }
}

static bool make_room(size_t triangles, size_t boxes, mesh_lists *made)
{
    const size_t bytes = (tribox_index_bytes(triangles) + 63) / 64 * 64;
    made->floats = malloc(3 * triangles * sizeof *made->floats);
    made->doubles = malloc(3 * triangles * sizeof *made->doubles);
    made->indices = malloc(3 * triangles * sizeof *made->indices);
    made->wide = malloc(boxes * sizeof *made->wide);
    made->moved = malloc(boxes * sizeof *made->moved);
    for (int k = 0; k < 2; k++)
        made->nodes[k] = aligned_alloc(64, bytes);
    return made->floats && made->doubles && made->indices && made->wide && made->moved && made->nodes[0] && made->nodes[1];
}

bool mesh_lists_make(const index_scene *scene, const ordered_soup *soup, const tribox_box *boxes, size_t count, uint32_t *list,
                     const char *kernel, mesh_lists *made)
{
    const size_t triangles = soup->room.soup.count;
    *made = (mesh_lists){.soup = soup, .boxes = boxes, .count = count, .list = list};
    const size_t vertices = make_room(triangles, count, made) ? weld_in_order(&scene->room.soup, soup->ids, made) : 0;
    bool is_made = vertices;
    move(made, vertices, index_scene_extent(scene));
    for (int k = 0; is_made && k < 2; k++) {
        made->mesh[k] = (tribox_mesh){.positions = k ? (const void *)made->doubles : made->floats,
                                      .vertices = vertices,
                                      .indices = made->indices,
                                      .index_bytes = 4,
                                      .count = triangles,
                                      .position_bytes = k ? 8 : 4};
        made->index[k] = (tribox_index){.nodes = made->nodes[k], .mesh = &made->mesh[k], .ids = soup->ids};
        is_made = !tribox_index_build(&made->index[k], &(tribox_options){.kernel = kernel}, made->nodes[k]);
    }
    if (!is_made)
        mesh_lists_free(made);
    return is_made || message_failure("no memory for meshes") == EXIT_CODE_OK;
}

void mesh_lists_free(mesh_lists *made)
{
    free(made->floats);
    free(made->doubles);
    free(made->indices);
    free(made->wide);
    free(made->moved);
    for (int k = 0; k < 2; k++)
        free(made->nodes[k]);
}

static const tribox_index *index_of(const mesh_lists *q, mesh_list_of of)
{
    return of < LIST_OF_MESH ? &q->soup->index : &q->index[of - LIST_OF_MESH];
}

static const tribox_box *boxes_of(const mesh_lists *q, mesh_list_of of)
{
    return of == LIST_OF_MESH_IN_DOUBLE ? q->moved : of == LIST_OF_WIDE_BOXES ? q->wide : q->boxes;
}

static bool ask(const mesh_lists *q, mesh_list_of of, size_t b, const tribox_options *options, size_t *found)
{
    return !tribox_index_list(index_of(q, of), &(tribox_region){.box = boxes_of(q, of) + b}, options, q->soup->room.soup.count,
                              q->list, found);
}

/* Whether a list is what is set in a mask, by the numbers of the file. */
static bool is_list_of(const mesh_lists *q, size_t found, const uint64_t *mask)
{
    size_t at = 0;
    for (size_t i = 0; i < q->soup->room.soup.count; i++)
        if (mask[i / 64] >> i % 64 & 1 && (at == found || q->list[at++] != q->soup->ids[i]))
            return false;
    return at == found;
}

bool mesh_lists_are_right(const mesh_lists *q, size_t boxes, uint64_t *mask, const char *kernel)
{
    const tribox_options options = {.kernel = kernel};
    for (mesh_list_of of = LIST_OF_SOUP; of < MESH_LISTS; of++)
        for (size_t b = 0; b < boxes; b++) {
            const tribox_box *const box = boxes_of(q, of) + b;
            size_t found;
            const bool is_known = of < LIST_OF_MESH ? !tribox_overlap(&q->soup->room.soup, box, &options, mask, NULL)
                                                    : !tribox_mesh_overlap(&q->mesh[of - LIST_OF_MESH], box, &options, mask, NULL);
            if (!is_known || !ask(q, of, b, &options, &found) || !is_list_of(q, found, mask))
                return message_failure("%s, box %zu: the list is wrong", names[of], b) == EXIT_CODE_OK;
        }
    return true;
}

static inline bool run_lists(const contestant *self, mesh_list_of of)
{
    const mesh_lists *const q = self->question;
    size_t found;
    for (size_t b = 0; b < q->count; b++)
        if (!ask(q, of, b, &self->options, &found))
            return false;
    return true;
}

#define RUN(name, of) \
    static bool run_##name(const contestant *self, uint64_t *mask, tribox_report *report) \
    { \
        (void)mask; \
        (void)report; \
        return run_lists(self, of); \
    }
RUN(soup, LIST_OF_SOUP)
RUN(wide_boxes, LIST_OF_WIDE_BOXES)
RUN(mesh, LIST_OF_MESH)
RUN(mesh_in_double, LIST_OF_MESH_IN_DOUBLE)

contestant mesh_lists_contestant(const mesh_lists *question, mesh_list_of of, const char *kernel)
{
    static bool (*const run[MESH_LISTS])(const contestant *, uint64_t *, tribox_report *) = {run_soup, run_wide_boxes, run_mesh,
                                                                                             run_mesh_in_double};
    contestant made = {.run = run[of],
                       .prepare = index_warm_up,
                       .question = question,
                       .options = {.kernel = kernel},
                       .pairs = (double)question->count};
    snprintf(made.name, sizeof made.name, "%s", names[of]);
    return made;
}

static bool run_build(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const mesh_lists *const q = self->question;
    (void)mask;
    (void)report;
    return !tribox_index_build(&q->index[0], &self->options, q->nodes[0]);
}

static bool run_build_in_double(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const mesh_lists *const q = self->question;
    (void)mask;
    (void)report;
    return !tribox_index_build(&q->index[1], &self->options, q->nodes[1]);
}

contestant mesh_lists_build(const mesh_lists *question, bool in_double, const char *kernel)
{
    return (contestant){.run = in_double ? run_build_in_double : run_build,
                        .question = question,
                        .options = {.kernel = kernel},
                        .pairs = (double)question->soup->room.soup.count};
}

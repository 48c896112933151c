/* box_after_box.c - from one stage of the index to the next, and the question at each. */
#define _POSIX_C_SOURCE 200809L
#include "box_after_box.h"

#include <stdlib.h>

#include "by_threads.h"
#include "console/clock.h"
#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"
#include "read/mesh.h"
#include "report.h"

enum { SCRATCH_BYTES = 16 /* a triangle, for an order */ };

static bool find_order(const mesh *m, unsigned threads, uint32_t *order)
{
    const size_t bytes = m->triangles * SCRATCH_BYTES;
    void *const scratch = pages_take(bytes);
    const tribox_status status = scratch ? sort_by_threads(m, threads, order, scratch) : MESSAGE_NO_MEMORY;
    pages_free(scratch, bytes);
    return !status;
}

/* The streams of so many triangles, one after the other: x of the three vertices, then y, then z. */
static void point_streams(float *coordinates, size_t count, float *streams[9], tribox_soup *soup)
{
    for (size_t k = 0; k < 9; k++)
        streams[k] = coordinates + k * count;
    for (size_t v = 0; v < 3; v++) {
        soup->x[v] = streams[v];
        soup->y[v] = streams[3 + v];
        soup->z[v] = streams[6 + v];
    }
    soup->count = count;
}

static bool gather_streams(mesh *m, unsigned threads, const uint32_t *order)
{
    const size_t count = m->soup.count;
    float *const coordinates = pages_take(9 * count * sizeof *coordinates);
    float *streams[9];
    tribox_soup ordered;
    if (!coordinates)
        return false;
    point_streams(coordinates, count, streams, &ordered);
    if (gather_by_threads(&m->soup, order, threads, streams)) {
        pages_free(coordinates, 9 * count * sizeof *coordinates);
        return false;
    }
    mesh_drop_floats(m);
    m->coordinates = coordinates;
    m->capacity = count;
    m->soup = ordered;
    return true;
}

/* Positions stay where they are. */
static bool reorder_corners(mesh *m, const uint32_t *order)
{
    uint32_t *const corners = malloc(3 * m->triangles * sizeof *corners);
    if (!corners)
        return false;
    for (size_t i = 0; i < m->triangles; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t corner = 3 * (size_t)order[i] + v;
            corners[3 * i + v] = m->corners ? m->corners[corner] : (uint32_t)corner;
        }
    free(m->corners);
    m->corners = corners;
    m->doubles.indices = corners;
    m->doubles.index_bytes = sizeof *corners;
    return true;
}

/*
 * Orders the triangles of a mesh. Returns the number that each had before, for free(); NULL, with the mesh as it was, where not as
 * much memory is available: another mesh and 4 bytes a triangle while it works, these 4 bytes afterwards.
 */
static uint32_t *mesh_order(mesh *m, unsigned threads)
{
    const size_t triangle_bytes = 9 * sizeof(float) + sizeof(uint32_t);
    if (m->triangles > memory_available() / triangle_bytes || (m->is_double && m->doubles.vertices > UINT32_MAX))
        return NULL;
    uint32_t *order = malloc(m->triangles * sizeof *order);
    if (order &&
        (!find_order(m, threads, order) || !(m->is_double ? reorder_corners(m, order) : gather_streams(m, threads, order)))) {
        free(order);
        order = NULL;
    }
    return order;
}

/* What it takes to reach a stage: roughly, as that is good enough (tribox-bench index). */
static const double seconds_per_triangle[] = {[INDEX_NONE] = 0, [INDEX_IN_FILE_ORDER] = 2e-9, [INDEX_ORDERED] = 100e-9};

/* FAST may say more by an index, and far triangles overlap where the axes of the box are left out. */
static bool is_for_index(const request *r, const mesh *m)
{
    const bool has_box_axes = !r->test.axes || r->test.axes & TRIBOX_AXES_BOX;
    return has_box_axes && !r->wants_inside && r->test.accuracy != TRIBOX_FAST && m->triangles <= UINT32_MAX;
}

int box_after_box_start(const request *r, mesh *m, box_after_box *b)
{
    *b = (box_after_box){.r = r, .m = m, .last = is_for_index(r, m) ? INDEX_ORDERED : INDEX_NONE};
    return masks_make(m->triangles, r->wants_inside, &b->bits);
}

/* Whether there is memory for a stage. Where there is not, nothing has changed. */
static bool prepare(box_after_box *b, index_stage stage)
{
    const size_t count = b->m->triangles;
    if (stage == INDEX_ORDERED)
        return (b->order = mesh_order(b->m, b->r->threads)) != NULL;
    b->nodes = malloc(tribox_index_bytes(count));
    return b->nodes && (!b->r->wants_list || found_words_make(&b->words, count));
}

static int step_where_it_pays(box_after_box *b)
{
    if (b->stage == b->last || b->seconds < seconds_per_triangle[b->stage + 1] * (double)b->m->triangles)
        return EXIT_CODE_OK;
    if (!prepare(b, b->stage + 1)) {
        b->last = b->stage;
        return EXIT_CODE_OK;
    }
    b->stage++;
    b->seconds = 0;
    b->index = (tribox_index){.nodes = b->nodes};
    if (b->m->is_double)
        b->index.mesh = &b->m->doubles;
    else
        b->index.soup = &b->m->soup;
    return message_status(index_by_threads(&b->index, b->m->triangles, &b->r->test, b->r->threads, b->nodes));
}

static tribox_status ask_index(box_after_box *b, const tribox_box *box, tribox_report *report)
{
    const tribox_region region = {.box = box};
    found_words *const w = &b->words;
    if (!b->r->wants_list)
        return tribox_index_overlap(&b->index, &region, &b->r->test, NULL, report);
    const tribox_status status =
        tribox_index_words(&b->index, &region, &b->r->test, w->room, w->number, w->bits, NULL, &w->count, report);
    if (!status && b->order)
        found_words_renumber(w, b->order);
    return status;
}

static int ask(box_after_box *b, answer *a)
{
    const asked_triangles all = triangles_of_mesh(b->m);
    if (b->stage == INDEX_NONE)
        return overlap_ask(b->r, &all, &b->bits, a);
    tribox_report report;
    const double start = clock_seconds();
    const tribox_status status = ask_index(b, &a->box, &report);
    a->seconds = clock_seconds() - start;
    if (status)
        return message_status(status);
    a->overlapping = report.overlapping;
    a->undecided = report.undecided;
    return EXIT_CODE_OK;
}

int box_after_box_ask(box_after_box *b, answer *a)
{
    int code = step_where_it_pays(b);
    if (!code)
        code = ask(b, a);
    a->stage = b->stage;
    b->seconds += a->seconds;
    return code;
}

int box_after_box_list(const box_after_box *b, answer *a)
{
    return b->stage == INDEX_NONE ? report_list(b->r, a, 0, b->bits.overlap, b->m->triangles) : report_words(b->r, a, &b->words);
}

void box_after_box_end(box_after_box *b)
{
    masks_free(&b->bits);
    found_words_free(&b->words);
    free(b->nodes);
    free(b->order);
}

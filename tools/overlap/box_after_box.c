/* box_after_box.c - an order and an index by several threads, from one stage to the next, and the question at each. */
#define _POSIX_C_SOURCE 200809L
#include "overlap.h"

#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "console/crew.h"
#include "console/system.h"
#include "console/message.h"
#include "tribox_threads.h"

/* ----------------------------------------------------------------------------------------------------------------------- shares */

/* Parts are so large that a thread pays; an order is cut into as many as a power of two of them. */
enum { PART_LEAST = 1 << 15, PARTS_MAX = 1024, PARTS_EACH = 4 };

typedef struct sharing {
    size_t count, each; /* triangles: of all, and of a part but the last */
    tribox_status (*work)(const void *data, size_t first, size_t count);
    const void *data;
} sharing;

static int share_part(void *data, void *place, size_t n)
{
    const sharing *const s = data;
    const size_t first = n * s->each, left = s->count - first;
    (void)place;
    return (int)s->work(s->data, first, left < s->each ? left : s->each);
}

/* Parts of whole blocks, one where it would be small. */
static tribox_status share(size_t count, unsigned threads, tribox_status (*work)(const void *, size_t, size_t), const void *data)
{
    const size_t fair = count / ((size_t)threads * PARTS_EACH), least = fair > PART_LEAST ? fair : PART_LEAST;
    sharing s = {.count = count, .work = work, .data = data};
    s.each = (least + TRIBOX_INDEX_BLOCK - 1) / TRIBOX_INDEX_BLOCK * TRIBOX_INDEX_BLOCK;
    return (tribox_status)crew_do(&(crew_work){.threads = threads, .count = (count + s.each - 1) / s.each, .step = share_part}, &s);
}

/* ------------------------------------------------------------------------------------------------------------------------ order */

enum { SCRATCH_BYTES = 16 /* a triangle, for an order */ };

typedef struct ordering {
    mesh *m;
    void *scratch;
    uint32_t *order;
    size_t parts, first[PARTS_MAX + 1]; /* part p: places first[p] .. first[p + 1] - 1 */
    float *streams;                     /* in order: nine of them, one behind the other */
} ordering;

static tribox_status start(const void *data, size_t first, size_t count)
{
    const ordering *const o = data;
    return o->m->is_double ? tribox_mesh_sort_start(&o->m->doubles, first, count, o->scratch)
                           : tribox_soup_sort_start(&o->m->soup, first, count, o->scratch);
}

/* Each of the arguments is sound by now. */
static int cut_part(void *data, void *place, size_t n)
{
    (void)place;
    ordering *const o = data;
    size_t *const at = o->first + n * (PARTS_MAX / o->parts), *const end = at + PARTS_MAX / o->parts;
    size_t before = 0;
    tribox_sort_cut(o->scratch, o->m->triangles, *at, *end - *at, &before);
    at[PARTS_MAX / o->parts / 2] = *at + before;
    return 0;
}

static int finish_part(void *data, void *place, size_t n)
{
    (void)place;
    ordering *const o = data;
    const size_t step = PARTS_MAX / o->parts, first = o->first[n * step];
    tribox_sort_finish(o->scratch, o->m->triangles, first, o->first[(n + 1) * step] - first, o->order);
    return 0;
}

/* What tribox_soup_sort or, of doubles, tribox_mesh_sort does. */
static bool find_order(ordering *o, unsigned threads)
{
    const size_t count = o->m->triangles, bytes = count * SCRATCH_BYTES;
    o->scratch = pages_take(bytes);
    const bool is_started = o->scratch && !share(count, threads, start, o);
    for (; is_started && o->parts < (size_t)threads * PARTS_EACH && o->parts < PARTS_MAX && count / o->parts > PART_LEAST;
         o->parts *= 2)
        crew_do(&(crew_work){.threads = threads, .count = o->parts, .step = cut_part}, o);
    if (is_started)
        crew_do(&(crew_work){.threads = threads, .count = o->parts, .step = finish_part}, o);
    pages_free(o->scratch, bytes);
    return is_started;
}

static tribox_status gather(const void *data, size_t first, size_t count)
{
    const ordering *const o = data;
    float *to[9];
    for (size_t k = 0; k < 9; k++)
        to[k] = o->streams + k * o->m->triangles + first;
    return tribox_soup_gather(&o->m->soup, o->order, first, count, to, to + 3, to + 6);
}

static bool gather_streams(ordering *o, unsigned threads)
{
    mesh *const m = o->m;
    const size_t count = m->soup.count;
    o->streams = pages_take(9 * count * sizeof *o->streams);
    if (!o->streams || share(count, threads, gather, o)) {
        pages_free(o->streams, 9 * count * sizeof *o->streams);
        return false;
    }
    mesh_drop_floats(m);
    m->coordinates = o->streams;
    m->capacity = count;
    m->soup = soup_of_streams(o->streams, count, count);
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
    mesh_drop_corners(m);
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
    ordering o = {.m = m, .order = malloc(m->triangles * sizeof *o.order), .parts = 1, .first = {[PARTS_MAX] = m->triangles}};
    if (o.order && find_order(&o, threads) && (m->is_double ? reorder_corners(m, o.order) : gather_streams(&o, threads)))
        return o.order;
    free(o.order);
    return NULL;
}

/* ------------------------------------------------------------------------------------------------------------------------ words */

/* Room for the words of so many triangles. Returns false if memory fails; else free(w->bits) gives it back. */
static bool found_words_make(found_words *w, size_t triangles)
{
    const size_t words = tribox_mask_words(triangles), touched = tribox_mask_words(words);
    uint64_t *const memory = calloc(2 * words + touched + words / 2 + 1, sizeof *memory);
    *w = (found_words){.room = words, .bits = memory};
    if (!memory)
        return false;
    w->mask = memory + words;
    w->touched = w->mask + words;
    w->number = (uint32_t *)(w->touched + touched);
    return true;
}

static void scatter(found_words *w, size_t word, const uint32_t *order)
{
    uint32_t bit[64];
    const size_t set = tribox_mask_indices(&w->bits[word], 64, bit);
    for (size_t i = 0; i < set; i++) {
        const uint32_t to = order[64 * (size_t)w->number[word] + bit[i]];
        w->mask[to / 64] |= UINT64_C(1) << to % 64;
        w->touched[to / 4096] |= UINT64_C(1) << to / 64 % 64;
    }
}

/*
 * Triangle i becomes triangle order[i]. Numbers are put into ascending order by setting bits, so nothing is compared: it takes time
 * for those found and a 4096th part of all.
 */
static void found_words_renumber(found_words *w, const uint32_t *order)
{
    for (size_t k = 0; k < w->count; k++)
        scatter(w, k, order);
    w->count = tribox_mask_indices(w->touched, w->room, w->number);
    memset(w->touched, 0, tribox_mask_words(w->room) * sizeof *w->touched);
    for (size_t k = 0; k < w->count; k++) {
        w->bits[k] = w->mask[w->number[k]];
        w->mask[w->number[k]] = 0;
    }
}

/* ----------------------------------------------------------------------------------------------------------------------- stages */

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

static tribox_status update(const void *data, size_t first, size_t count)
{
    const box_after_box *const b = data;
    return tribox_index_update(&b->index, first, count, &b->r->test, b->nodes);
}

/* What tribox_index_build does, by threads where there is enough for them. */
static tribox_status build_index(const box_after_box *b)
{
    const size_t count = b->m->triangles;
    if (b->r->threads < 2 || count <= PART_LEAST)
        return tribox_index_build(&b->index, &b->r->test, b->nodes);
    const tribox_status status = share(count, b->r->threads, update, b);
    return status ? status : update(b, 0, 0);
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
    return message_status(build_index(b));
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
    free(b->words.bits);
    free(b->nodes);
    free(b->order);
}

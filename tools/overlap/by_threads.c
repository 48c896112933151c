/* by_threads.c - shares out the steps that tribox_threads.h and tribox_index_update offer. */
#define _POSIX_C_SOURCE 200809L
#include "by_threads.h"

#include "console/crew.h"
#include "tribox_threads.h"

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

typedef struct sorting {
    const mesh *m;
    void *scratch;
    uint32_t *order;
    size_t parts, first[PARTS_MAX + 1]; /* part p: places first[p] .. first[p + 1] - 1 */
} sorting;

static tribox_status start(const void *data, size_t first, size_t count)
{
    const sorting *const s = data;
    return s->m->is_double ? tribox_mesh_sort_start(&s->m->doubles, first, count, s->scratch)
                           : tribox_soup_sort_start(&s->m->soup, first, count, s->scratch);
}

/* Each of the arguments is sound by now. */
static int cut_part(void *data, void *place, size_t n)
{
    (void)place;
    sorting *const s = data;
    size_t *const at = s->first + n * (PARTS_MAX / s->parts), *const end = at + PARTS_MAX / s->parts;
    size_t before = 0;
    tribox_sort_cut(s->scratch, s->m->triangles, *at, *end - *at, &before);
    at[PARTS_MAX / s->parts / 2] = *at + before;
    return 0;
}

static int finish_part(void *data, void *place, size_t n)
{
    (void)place;
    sorting *const s = data;
    const size_t step = PARTS_MAX / s->parts, first = s->first[n * step];
    tribox_sort_finish(s->scratch, s->m->triangles, first, s->first[(n + 1) * step] - first, s->order);
    return 0;
}

tribox_status sort_by_threads(const mesh *m, unsigned threads, uint32_t *order, void *scratch)
{
    sorting s = {.m = m, .scratch = scratch, .order = order, .parts = 1, .first = {[PARTS_MAX] = m->triangles}};
    const tribox_status status = share(m->triangles, threads, start, &s);
    if (status)
        return status;
    for (; s.parts < (size_t)threads * PARTS_EACH && s.parts < PARTS_MAX && m->triangles / s.parts > PART_LEAST; s.parts *= 2)
        crew_do(&(crew_work){.threads = threads, .count = s.parts, .step = cut_part}, &s);
    crew_do(&(crew_work){.threads = threads, .count = s.parts, .step = finish_part}, &s);
    return TRIBOX_OK;
}

typedef struct gathering {
    const tribox_soup *soup;
    const uint32_t *order;
    float *const *streams;
} gathering;

static tribox_status gather(const void *data, size_t first, size_t count)
{
    const gathering *const g = data;
    float *to[9];
    for (int k = 0; k < 9; k++)
        to[k] = g->streams[k] + first;
    return tribox_soup_gather(g->soup, g->order, first, count, to, to + 3, to + 6);
}

tribox_status gather_by_threads(const tribox_soup *soup, const uint32_t *order, unsigned threads, float *const streams[9])
{
    return share(soup->count, threads, gather, &(gathering){soup, order, streams});
}

typedef struct indexing {
    const tribox_index *index;
    const tribox_options *options;
    void *nodes;
} indexing;

static tribox_status update(const void *data, size_t first, size_t count)
{
    const indexing *const i = data;
    return tribox_index_update(i->index, first, count, i->options, i->nodes);
}

tribox_status index_by_threads(const tribox_index *index, size_t count, const tribox_options *options, unsigned threads,
                               void *nodes)
{
    if (threads < 2 || count <= PART_LEAST)
        return tribox_index_build(index, options, nodes);
    const indexing i = {index, options, nodes};
    const tribox_status status = share(count, threads, update, &i);
    return status ? status : update(&i, 0, 0);
}

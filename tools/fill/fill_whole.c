/* fill_whole.c - parity by windows of layers, which threads take in turn; the outside in one call. */
#define _POSIX_C_SOURCE 200809L
#include "fill_whole.h"

#include "console/crew.h"
#include "tribox_threads.h"

/* Each window looks at all triangles: there are twice as many as threads, so that none waits long, and no more. */
enum { EACH = 2 };

typedef struct layer_fill {
    const mesh *m;
    whole_fill *f;
    uint32_t windows;
    size_t inside[EACH * THREADS_MAX], odd_rows[EACH * THREADS_MAX]; /* of each */
} layer_fill;

static uint32_t windows_of(const tribox_grid *grid, unsigned threads)
{
    const uint32_t wanted = threads > 1 ? EACH * threads : 1;
    return wanted < grid->size[2] ? wanted : grid->size[2];
}

/* Layers from .. to - 1. */
static uint32_t border_of(const layer_fill *l, uint32_t window)
{
    return (uint32_t)((uint64_t)l->f->grid->size[2] * window / l->windows);
}

static size_t window_bytes(const tribox_grid *grid, uint32_t windows)
{
    return tribox_fill_bytes((const uint32_t[3]){grid->size[0], grid->size[1], grid->size[2] / windows + 1});
}

size_t fill_whole_bytes(const tribox_grid *grid, unsigned threads)
{
    const uint32_t windows = windows_of(grid, threads);
    return windows * window_bytes(grid, windows);
}

static int fill_layers(void *data, void *place, size_t n)
{
    layer_fill *const l = data;
    const tribox_grid *const grid = l->f->grid;
    const uint32_t from = border_of(l, (uint32_t)n), layers = border_of(l, (uint32_t)n + 1) - from;
    const tribox_window w = {{0, 0, from}, {grid->size[0], grid->size[1], layers}};
    const size_t before = tribox_mask_words(grid->size[0]) * grid->size[1] * from;
    const uint64_t *const surface = l->f->surface + before;
    uint64_t *const solid = l->f->solid + before;
    size_t *const inside = &l->inside[n], *const odd_rows = &l->odd_rows[n];
    void *const scratch = (char *)l->f->scratch + n * window_bytes(grid, l->windows);
    (void)place;
    return l->m->is_double
               ? (int)tribox_mesh_fill_parity_window(&l->m->doubles, grid, &w, surface, scratch, solid, inside, odd_rows)
               : (int)tribox_fill_parity_window(&l->m->soup, grid, &w, surface, scratch, solid, inside, odd_rows);
}

tribox_status fill_whole(const mesh *m, unsigned threads, whole_fill *f)
{
    layer_fill l = {.m = m, .f = f, .windows = windows_of(f->grid, threads)};
    f->inside = f->odd_rows = 0;
    if (!m)
        return tribox_fill_outside(f->grid->size, f->surface, f->scratch, f->solid, &f->inside);
    const int status = crew_do(&(crew_work){.threads = threads, .count = l.windows, .step = fill_layers}, &l);
    for (uint32_t n = 0; n < l.windows; n++) {
        f->inside += l.inside[n];
        f->odd_rows += l.odd_rows[n];
    }
    return (tribox_status)status;
}

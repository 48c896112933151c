/* fill_whole.c - parity by windows of layers, which threads take in turn; the outside in one call. */
#define _POSIX_C_SOURCE 200809L
#include "fill_whole.h"

#include <pthread.h>

#include "console/crew.h"
#include "tribox_threads.h"

/* Each window looks at all triangles: there are twice as many as threads, so that none waits long, and no more. */
enum { EACH = 2 };

typedef struct layer_crew {
    const mesh *m;
    whole_fill *f;
    uint32_t windows;
    pthread_mutex_t lock; /* of what follows, and of the sums */
    uint32_t next;
    tribox_status status;
} layer_crew;

static uint32_t windows_of(const tribox_grid *grid, unsigned threads)
{
    const uint32_t wanted = threads > 1 ? EACH * threads : 1;
    return wanted < grid->size[2] ? wanted : grid->size[2];
}

/* Layers from .. to - 1. */
static uint32_t border_of(const layer_crew *c, uint32_t window)
{
    return (uint32_t)((uint64_t)c->f->grid->size[2] * window / c->windows);
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

static tribox_status fill_layers(const layer_crew *c, uint32_t window, size_t *inside, size_t *odd_rows)
{
    const tribox_grid *const grid = c->f->grid;
    const uint32_t from = border_of(c, window), layers = border_of(c, window + 1) - from;
    const tribox_window w = {{0, 0, from}, {grid->size[0], grid->size[1], layers}};
    const size_t before = tribox_mask_words(grid->size[0]) * grid->size[1] * from;
    const uint64_t *const surface = c->f->surface + before;
    uint64_t *const solid = c->f->solid + before;
    void *const scratch = (char *)c->f->scratch + window * window_bytes(grid, c->windows);
    return c->m->is_double ? tribox_mesh_fill_parity_window(&c->m->doubles, grid, &w, surface, scratch, solid, inside, odd_rows)
                           : tribox_fill_parity_window(&c->m->soup, grid, &w, surface, scratch, solid, inside, odd_rows);
}

static bool take_window(layer_crew *c, uint32_t *window)
{
    pthread_mutex_lock(&c->lock);
    *window = c->next;
    const bool is_left = !c->status && c->next < c->windows;
    c->next += is_left;
    pthread_mutex_unlock(&c->lock);
    return is_left;
}

static void fill_in_turn(void *data, unsigned thread)
{
    layer_crew *const c = data;
    (void)thread;
    for (uint32_t window; take_window(c, &window);) {
        size_t inside = 0, odd_rows = 0;
        const tribox_status status = fill_layers(c, window, &inside, &odd_rows);
        pthread_mutex_lock(&c->lock);
        c->status = status ? status : c->status;
        c->f->inside += inside;
        c->f->odd_rows += odd_rows;
        pthread_mutex_unlock(&c->lock);
    }
}

tribox_status fill_whole(const mesh *m, unsigned threads, whole_fill *f)
{
    layer_crew c = {.m = m, .f = f, .windows = windows_of(f->grid, threads)};
    f->inside = f->odd_rows = 0;
    if (!m)
        return tribox_fill_outside(f->grid->size, f->surface, f->scratch, f->solid, &f->inside);
    pthread_mutex_init(&c.lock, NULL);
    crew_run(threads, fill_in_turn, &c);
    pthread_mutex_destroy(&c.lock);
    return c.status;
}

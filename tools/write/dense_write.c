/* dense_write.c - threads that put what is there, some layers each. */
#define _POSIX_C_SOURCE 200809L
#include "console/crew.h"
#include "console/message.h"
#include "console/steps.h"
#include "dense_out.h"

/* Layers of so many bytes are taken at once: fewer are not worth a thread. */
enum { STEP = 1 << 24 };

typedef struct writing {
    dense_out *out;
    const voxels *v;
    uint32_t step; /* layers */
    steps left;
    dense_room *first; /* of the calling thread, which is there before any other begins */
    progress *bar;
} writing;

static void put_step(writing *w, dense_room *room, uint32_t first)
{
    const uint32_t size = w->v->grid.size[2], end = size - first < w->step ? size : first + w->step;
    for (uint32_t k = first, layers; k < end; k += layers) {
        layers = voxels_layers_from(w->v, k);
        layers = layers < end - k ? layers : end - k;
        dense_put(w->out, room, k, layers, voxels_layer(w->v, k), voxels_layer_inside(w->v, k));
    }
}

/* Who has no memory leaves the steps to others; that the first has none dense_put says. */
static void work(void *data, unsigned thread)
{
    writing *const w = data;
    dense_room *const room = thread ? dense_room_new() : w->first;
    for (size_t n; (room || !thread) && steps_take(&w->left, &n);) {
        put_step(w, room, (uint32_t)n * w->step);
        if (!thread)
            progress_tell(w->bar, (double)(n + 1) / (double)w->left.count);
    }
    dense_room_free(room);
}

int dense_write(const volume_frame *frame, const file_out *file, const voxels *v, unsigned threads, progress *bar)
{
    dense_out out;
    const uint32_t *const size = v->grid.size;
    const uint64_t layer = (uint64_t)size[0] * size[1], step = STEP / layer;
    writing w = {.out = &out, .v = v, .bar = bar, .step = step ? (uint32_t)step : 1};
    w.first = dense_room_new();
    dense_start(&out, frame, file, v);
    steps_start(&w.left, (size[2] + w.step - 1) / w.step);
    crew_run(!out.has_places ? 1 : threads < w.left.count ? threads : (unsigned)w.left.count, work, &w);
    steps_free(&w.left);
    return dense_end(&out);
}

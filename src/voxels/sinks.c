/* sinks.c - empty sinks, and what kernels leave to others while they fill them. */
#include "voxelizing.h"

static void write_listed_bits(tribox_voxels *v) { v->plan.kernel->cells->write(v); }

static const tribox_voxel_handlers handlers = {
    .write = write_listed_bits,
    .take_triangle = tribox_voxels_take_triangle,
    .add_triangle = tribox_voxels_add_triangle,
    .settle_waiting = tribox_voxels_settle_waiting,
};

void tribox_voxels_empty_sinks(tribox_voxels *v, uint64_t *occupied)
{
    const int64_t layers = v->window.end_layer - v->window.first_layer;
    v->sinks.row_words = tribox_words_of(v->window.size[0]);
    v->sinks.row_halves = (int32_t)(2 * v->sinks.row_words);
    v->sinks.layer_halves = (int32_t)(uint32_t)(2 * v->sinks.row_words * v->window.size[1]);
    v->sinks.occupied = occupied;
    v->sinks.ids = (tribox_cell_ids){.of = NULL};
    v->sinks.pairs = NULL;
    v->sinks.handlers = &handlers;
    v->sinks.is_far = v->sinks.row_words * v->window.size[1] * (size_t)layers > 1 << 17;
    v->counts = (tribox_report){0, 0};
    v->sinks.waiting.count = v->sinks.writes.count = 0;
    for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
        v->sinks.strip[shape].count = 0;
    for (tribox_class kind = TRIBOX_FLATS; kind < TRIBOX_CLASSES; kind++)
        v->sinks.queue[kind].count = 0;
}

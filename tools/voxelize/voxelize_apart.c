/* voxelize_apart.c - a mesh into a dense file, which gets layers as they are done, in memory for some layers of each thread. */
#define _POSIX_C_SOURCE 200809L
#include "console/clock.h"
#include "console/message.h"
#include "layers.h"
#include "voxelize_ways.h"
#include "write/dense_out.h"
#include "write/voxels_room.h"

static const char fewer[] = "choose fewer cells, or write bricks, -o FILE.npz or .vdb";

/* Each thread that works has a room. */
typedef struct putting {
    dense_out out;
    dense_room *room[THREADS_MAX];
} putting;

static bool take_room(void *data, unsigned thread)
{
    putting *const p = data;
    p->room[thread] = dense_room_new();
    return p->room[thread];
}

static bool put_layers(void *data, unsigned thread, uint32_t first, uint32_t layers, const uint64_t *words)
{
    putting *const p = data;
    return dense_put(&p->out, p->room[thread], first, layers, words, NULL);
}

static tribox_status run(const voxelize_request *r, const voxelize_input *in, putting *p, voxelize_answer *a)
{
    const voxel_task task = voxelize_task(r, in);
    const layers_taker taker = {take_room, put_layers, p};
    progress bar = progress_start("voxelizing", !r->result.is_quiet);
    const double start = clock_seconds();
    p->room[0] = dense_room_new();
    const tribox_status status =
        voxelize_layers_apart(&task, r->threads, &taker, &a->report, bar.is_wanted ? progress_tell : NULL, &bar);
    a->seconds = clock_seconds() - start;
    progress_end(&bar);
    for (unsigned t = 0; t < THREADS_MAX; t++)
        dense_room_free(p->room[t]);
    return status;
}

int voxelize_apart(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a)
{
    putting p = {.room = {NULL}};
    int code = voxels_check_words(&in->cells.grid, fewer);
    if (code)
        return code;
    dense_start(&p.out, r->result.format->frame, &files->out, &in->cells);
    const tribox_status status = run(r, in, &p, a);
    if (status == TRIBOX_OK || status == TRIBOX_STOPPED)
        code = dense_end(&p.out);
    else
        dense_drop(&p.out);
    if (!code && status)
        code = status == TRIBOX_STOPPED ? message_failure("out of memory for layers of cells") : message_status(status);
    return code ? code : file_out_keep(&files->out);
}

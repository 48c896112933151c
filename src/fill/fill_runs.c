/* fill_runs.c - how many runs of free cells a part of a grid can have, and their scratch. */
#include "fill_runs.h"

#include "grid/grid_cells.h"

/* Every other cell. */
static uint64_t most_runs_of(uint32_t cells) { return (uint64_t)cells / 2 + cells % 2; }

bool tribox_runs_are_served(const uint32_t size[3])
{
    const uint64_t most = (UINT64_C(1) << 31) - 1, rows = (uint64_t)size[1] * size[2];
    return tribox_fill_is_served(size) && most_runs_of(size[0]) <= most / rows;
}

size_t tribox_runs_bytes(const uint32_t size[3])
{
    const uint64_t rows = (uint64_t)size[1] * size[2], most = most_runs_of(size[0]);
    const uint64_t spans = 2 * (uint64_t)size[1] * most;
    const uint64_t bytes = spans * sizeof(tribox_run) + (rows * most + rows + 2) * sizeof(uint32_t);
    return bytes > SIZE_MAX ? SIZE_MAX : (size_t)bytes;
}

tribox_runs tribox_runs_in(const uint32_t size[3], const uint64_t *occupied, void *scratch)
{
    const size_t off = (uintptr_t)scratch % sizeof(uint32_t);
    tribox_runs r = {.size = {size[0], size[1], size[2]},
                     .rows = tribox_rows_of(size),
                     .most = (size_t)most_runs_of(size[0]),
                     .occupied = occupied};
    r.first = (uint32_t *)(void *)((char *)scratch + (off ? sizeof(uint32_t) - off : 0));
    r.parents = r.first + r.rows.count + 1;
    r.spans[0] = (tribox_run *)(void *)(r.parents + r.rows.count * r.most);
    r.spans[1] = r.spans[0] + size[1] * r.most;
    return r;
}

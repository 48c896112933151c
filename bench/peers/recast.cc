// recast.cc - Recast's heightfield of spans, for peer_recast.py: columns along y, over rows along x and layers along z.
#include <ctime>
#include <recastnavigation/Recast.h>

static double seconds()
{
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

// Processor time until the spans are there; cells[z][y][x] gets those that they hold. Negative if there is no memory.
extern "C" double recast_cells(const float *vertices, int count, const int *faces, int triangles, const unsigned char *areas,
                               const float *lo, const float *hi, float cell, const int *size, unsigned char *cells)
{
    rcContext context(false);
    const double begin = seconds();
    rcHeightfield *const field = rcAllocHeightfield();
    const bool is_done = field && rcCreateHeightfield(&context, *field, size[0], size[2], lo, hi, cell, cell) &&
                         rcRasterizeTriangles(&context, vertices, count, faces, areas, triangles, *field);
    const double taken = seconds() - begin;
    for (long column = 0; is_done && column < long(size[0]) * size[2]; column++)
        for (const rcSpan *s = field->spans[column]; s; s = s->next)
            for (unsigned y = s->smin; y < s->smax && y < unsigned(size[1]); y++)
                cells[(column / size[0] * size[1] + y) * size[0] + column % size[0]] = 1;
    rcFreeHeightField(field);
    return is_done ? taken : -1;
}

/* fill_crossings.c - triangles and the rays along x: which way each triangle takes, and what all ways write. */
#include "fill_crossings.h"

/* Whether it can have one, seen along x: two vertices that are one point there, or no extent, leave none. */
static bool may_have_area(double u[3][3])
{
    bool is_line = false;
    for (int a = 1; a < 3; a++)
        is_line |= u[0][a] == u[1][a] && u[1][a] == u[2][a];
    for (int j = 0; j < 3; j++)
        is_line |= u[j][1] == u[(j + 1) % 3][1] && u[j][2] == u[(j + 1) % 3][2];
    return !is_line;
}

void tribox_crossings_doubtful(tribox_crossings *c, double u[3][3])
{
    if (tribox_are_finite_doubles(&u[0][0], 9) && may_have_area(u))
        tribox_crossings_exactly(c, u);
}

const tribox_crossing_handlers tribox_exact_crossings = {.add_row = tribox_crossings_row,
                                                         .add_doubtful = tribox_crossings_doubtful};

void tribox_crossings_add(tribox_crossings *c, const tribox_seen_along *seen, size_t count)
{
    if (c->middles.has_places) {
        c->kernel->rows->cross(c, seen, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        double u[3][3];
        for (int n = 0; n < 9; n++)
            u[n % 3][n / 3] = seen->number[n][i];
        tribox_crossings_doubtful(c, u);
    }
}

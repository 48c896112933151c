/* local_bounds.c - what nodes of doubles are made of, and compared with: floats that keep the order of doubles. */
#include "local_bounds.h"

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/floats.h"

float tribox_number_seen(double number, double origin)
{
    const float seen = (float)(number - origin);
    return seen > FLT_MAX ? FLT_MAX : seen < -FLT_MAX ? -FLT_MAX : seen;
}

/* What lies inside is not even rounded to a bound. */
void tribox_node_box_seen(const tribox_box *box, const double origin[3], tribox_node_box *seen)
{
    for (int a = 0; a < 3; a++) {
        seen->outer[a] = tribox_number_seen(box->lo[a], origin[a]);
        seen->outer[3 + a] = tribox_number_seen(box->hi[a], origin[a]);
        seen->inner[a] = tribox_float_above(seen->outer[a]);
        seen->inner[3 + a] = tribox_float_below(seen->outer[3 + a]);
    }
}

void tribox_node_widen(const tribox_node *node, tribox_node *wide)
{
    *wide = *node;
    for (int a = 0; a < 3; a++)
        for (int c = 0; c < 64; c++) {
            wide->bound[a][c] = tribox_float_below(node->bound[a][c]);
            wide->bound[3 + a][c] = tribox_float_above(node->bound[3 + a][c]);
        }
}

static void read_origin(const void *children, size_t c, double origin[3])
{
    memcpy(origin, (const char *)children + c * sizeof(tribox_node) + offsetof(tribox_node, origin), 3 * sizeof *origin);
}

/*
 * A bound from one origin to another. The numbers that it was rounded from lie between the floats beside it: these, moved to where
 * the numbers were, are still beyond them when that has been rounded.
 */
static void move_bounds(tribox_node *node, size_t c, const double from[3])
{
    for (int a = 0; a < 3; a++) {
        float *const lower = &node->bound[a][c], *const upper = &node->bound[3 + a][c];
        *lower = tribox_number_seen(from[a] + (double)tribox_float_below(*lower), node->origin[a]);
        *upper = tribox_number_seen(from[a] + (double)tribox_float_above(*upper), node->origin[a]);
    }
}

/* The origin is that of the first child that is somewhere. */
void tribox_bounds_join(const void *children, size_t count, tribox_node *node)
{
    bool has_origin = false;
    for (size_t c = 0; c < count; c++) {
        double from[3];
        if (node->bound[0][c] > node->bound[3][c])
            continue;
        read_origin(children, c, from);
        if (!has_origin)
            memcpy(node->origin, from, sizeof from);
        has_origin = true;
        move_bounds(node, c, from);
    }
}

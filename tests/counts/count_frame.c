/*
 * count_frame.c - counts the roundings of moving points into the frame of an oriented box: PROOFS.md 8.1, 8.3.
 *
 * What is linear here is space, all three axes of it at once, and a row of the frame: numbers 0 and 1 for the vocabulary. The
 * numbers of the row were rounded once, as those of doubles are. Points of doubles are rounded before they are moved from a center
 * that is then zero: once, as the others are here.
 */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/pairs/tail.h"
#include "kernel/frame.h"
#include "kernel/pairs/move.h"
#include "kernel/nodes/nodes.h"
#include "kernel/nodes/slabs.h"
#include "claims.h"
#include "tally.h"
#include "taken.h"

enum { SPACE, ROW };

static tally point, corner;
static double under;

/* All rows alike. */
static lane_frame frame_of(const double row[3])
{
    lane_frame frame;
    for (int a = 0; a < 3; a++) {
        frame.center[a] = count_input(SPACE, 0, true);
        count_here = COUNT_HERE;
        for (int k = 0; k < 3; k++) {
            frame.axis[k][a] = count_rounded(count_input(ROW, row[a], false), 0);
            frame.size[k][a] = v_abs(frame.axis[k][a]);
        }
        frame.lost[a] = v_splat(V_ETA);
    }
    return frame;
}

/*
 * Three vertices that are moved together, d[j] away from the center on one axis: in the order of what they are away, and by their
 * signs, 0 and that alone are the edges.
 */
static void count_points(int axis, const int d[3], int of_row)
{
    static const float number[9] = {0, 1, 2, 3, 4, 5, 6, 7, 8}; /* places among those that are given */
    const double row[3] = {of_row == 0, of_row == 1, of_row == 2};
    const double farthest = most_of(abs(d[0]), most_of(abs(d[1]), abs(d[2])));
    const tribox_soup soup = {.x = {number, number + 1, number + 2},
                              .y = {number + 3, number + 4, number + 5},
                              .z = {number + 6, number + 7, number + 8},
                              .count = 1};
    static vnum u[9];
    vnum q[3][3], error[3];
    count_start(0);
    const lane_frame frame = frame_of(row);
    for (int k = 0; k < 9; k++)
        u[k] = count_input(SPACE, k / 3 == axis ? d[k % 3] : 0, true);
    count_memory = u;
    move_packet(&soup, &frame, 0, q, error);
    for (int j = 0; j < 3; j++) {
        tally_both(&point, count_of(q[j][0]), axis == of_row ? farthest : 0, count_of(error[0]), 1);
        under = most_of(under, count_of(q[j][0])->under[0]);
    }
}

/* Lower and upper bounds of a child on an axis: these are the edges of what their signs, and the longer of the two, leave. */
static void count_corners(int axis, const double bounds[2], int of_row, double sign)
{
    const double row[3] = {of_row == 0 ? sign : 0, of_row == 1 ? sign : 0, of_row == 2 ? sign : 0};
    const bool is_up[3] = {row[0] > 0, row[1] > 0, row[2] > 0};
    const double farthest = most_of(fabs(bounds[0]), fabs(bounds[1]));
    lane_bound child;
    count_start(0);
    const lane_frame frame = frame_of(row);
    for (int k = 0; k < 6; k++)
        child.of[k] = count_input(SPACE, k % 3 == axis ? bounds[k / 3] : 0, true);
    const lane_span span = span_in_frame(&child, &frame, 0, is_up);
    tally_both(&corner, count_of(span.least), axis == of_row ? farthest : 0, count_of(span.error), 1);
    tally_both(&corner, count_of(span.most), axis == of_row ? farthest : 0, count_of(span.error), 1);
}

int main(int argc, char **argv)
{
    static const double bounds[5][2] = {{1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}};
    claims_start(argc, argv);
    for (int k = 0; k < 9; k++) {
        for (int n = 0; n < 27; n++) {
            const int d[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            count_points(k % 3, d, k / 3);
        }
        for (int b = 0; b < 5; b++) {
            count_corners(k % 3, bounds[b], k / 3, 1);
            count_corners(k % 3, bounds[b], k / 3, -1);
        }
    }
    claim_tally("point in a frame", &point);
    claim_taken("point in a frame, underflow", under, taken_eta());
    claim_tally("corner in a frame", &corner);
    return claims_end();
}

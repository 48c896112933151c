/*
 * count_frame.c - counts the roundings of moving points into the frame of an oriented box: PROOFS.md 8.1, 8.3.
 *
 * What is linear here is space, all three axes of it at once, and a row of the frame: numbers 0 and 1 for the vocabulary. The
 * numbers of the row were rounded once, as those of doubles are. Points of doubles are rounded before they are moved from a center
 * that is then zero: once, as the others are here.
 */
#include "vec_count.h"
#include "kernel/axes.h"
#include "kernel/frame.h"
#include "kernel/nodes/nodes.h"
#include "kernel/nodes/slabs.h"
#include "claims.h"
#include "tally.h"
#include "taken.h"

enum { SPACE, ROW };

static tally point, corner;
static double under;

static lane_frame frame_of(const double row[3])
{
    lane_frame frame;
    for (int a = 0; a < 3; a++) {
        frame.center[a] = count_input(SPACE, 0, true);
        count_here = COUNT_HERE;
        frame.axis[0][a] = count_rounded(count_input(ROW, row[a], false), 0);
        frame.size[0][a] = v_abs(frame.axis[0][a]);
    }
    frame.eta[0] = v_splat(V_ETA);
    return frame;
}

/* A vertex beside the center, as far from it as any that is moved with it: unit vectors are the edges of every orthant. */
static void count_point(int axis, int of_row)
{
    const double row[3] = {of_row == 0, of_row == 1, of_row == 2};
    vnum d[3], most[3];
    count_start(0);
    const lane_frame frame = frame_of(row);
    for (int a = 0; a < 3; a++) {
        d[a] = v_sub(count_input(SPACE, a == axis, true), frame.center[a]);
        most[a] = v_abs(d[a]);
    }
    const counted *const q = count_of(dot3(frame.axis[0], d)), *const bound = count_of(frame_error(&frame, 0, most));
    tally_both(&point, q, axis == of_row, bound, 1);
    under = most_of(under, q->under[0]);
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
        count_point(k % 3, k / 3);
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

/* order_why.h - why an order is fast or slow: which axis rejects, and what is still left and loaded after each group of axes. */
#ifndef ORDER_WHY_H
#define ORDER_WHY_H

#include "timing/work.h"

/* The thirteen axes: 0 to 2 the box normals x, y, z; 3 the plane; 4 + 3 i + j the edge axis e_i x f_j. */
enum { WHY_AXES = 13, WHY_PLANE = 3, WHY_EDGES = 4 };
enum { WHY_ORDERS = 6, WHY_WIDTHS = 4 };

/* A short name of an axis: x y z plane xe0 xe1 xe2 ye0 ... */
const char *why_axis_name(int axis);

extern const unsigned why_orders[WHY_ORDERS]; /* 123, 132, ... */
extern const unsigned why_lanes[WHY_WIDTHS];  /* 1, 4, 8, 16 */

/* The index of a kernel's lanes in why_lanes, by its name; "paper" has one. */
int why_width_of(const char *kernel);

typedef struct why_order {
    size_t first[WHY_AXES];             /* pairs by the axis that is the first to reject them, one pair at a time */
    size_t packets_left[WHY_WIDTHS][3]; /* packets with a pair left after the first, second and third group */
    size_t bytes[WHY_WIDTHS];           /* of the streams, loaded: y and z only for packets that x, and x and y, left */
} why_order;

typedef struct why {
    size_t pairs; /* with finite coordinates: the others are in no count but those of packets and bytes */
    size_t overlapping;
    size_t apart[WHY_AXES];     /* pairs that the axis separates, whatever the other axes do */
    size_t only[WHY_AXES];      /* pairs that this axis alone separates */
    size_t unboxed[WHY_AXES];   /* pairs that no box normal separates, but the axis does */
    size_t packets[WHY_WIDTHS]; /* of all jobs */
    why_order order[WHY_ORDERS];
} why;

void why_find(const timing_work *work, why *found);

#endif

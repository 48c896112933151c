/* faulty.h - a separating-axis test in double with a fault put in on purpose: the tests of the cross-check itself. */
#ifndef TRIBOX_TESTS_FAULTY_H
#define TRIBOX_TESTS_FAULTY_H

#include "compare.h"

typedef enum fault {
    FAULT_NONE,
    FAULT_NO_EDGES,
    FAULT_NO_PLANE,
    FAULT_NO_BOX,
    FAULT_ONE_EDGE_AXIS_LOST,
    FAULT_OPEN, /* touching is apart: < for <= */
    FAULT_SHRUNK,
    FAULT_SHRUNK_A_LITTLE,
    FAULT_INFLATED,
    FAULT_INFLATED_A_LITTLE,
    FAULT_PLANE_RADIUS_SHORT,
    FAULT_PLANE_ONE_SIDED,
    FAULT_WRONG_VERTICES,
    FAULT_SIX_SEPARATING, /* the plane's radius is its largest term */
    FAULT_LANE_COPIED,
    FAULT_LAST_LOST, /* the last five triangles overlap nothing */
    FAULT_FLIPS,     /* one answer in some ten thousand is turned round */
    FAULTS
} fault;

const char *fault_name(fault f);

/* Sound for data whose products are exact in double. */
typedef struct faulty {
    answerer base;
    fault fault;
    size_t triangles; /* in the soup */
    random_source r;
    size_t false_no, false_yes; /* how many answers the fault has changed */
} faulty;

faulty faulty_make(fault f, size_t triangles, uint64_t seed);

#endif

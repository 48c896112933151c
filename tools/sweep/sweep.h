/* sweep.h - every order and every choice of axes, on every kernel, against each other; and why an order is fast or slow. */
#ifndef SWEEP_H
#define SWEEP_H

#include <stdio.h>

#include "console/json.h"
#include "read/mesh.h"
#include "timing/timing.h"

/* ---- what is timed: a mesh against one box, cells of a grid, or the leaves of an octree -------------------------------------- */

typedef enum sweep_kind { SWEEP_OCTREE, SWEEP_GRID, SWEEP_BOX } sweep_kind;

typedef struct sweep_wish {
    sweep_kind kind;
    tribox_box box; /* of SWEEP_BOX */
    unsigned depth; /* of SWEEP_OCTREE; 0 for one that suits the mesh, and then written */
    unsigned along; /* of SWEEP_GRID: cells along the longest side */
} sweep_wish;

/* More cells are finer than floats can tell apart. */
enum { CELLS_ALONG_MOST = 4096, OCTREE_DEPTH_MOST = 10 };

/* Makes the work. Returns an exit_code; on success timing_work_free gives the memory back. path: of the mesh, for messages. */
int sweep_work_make(const char *path, const mesh *m, sweep_wish *wish, timing_work *work);

/* The wish in words, as in "the leaves of an octree of depth 6, ...". */
void sweep_work_describe(const sweep_wish *wish, const timing_work *work, char *text, size_t size);

/* ---- times ------------------------------------------------------------------------------------------------------------------- */

/* The first order is the one that tribox finds as it goes. */
enum { SWEEP_ORDERS = 7, SWEEP_ACCURACIES = 3, SWEEP_AXES = 6, SWEEP_ROUNDS = 32, SWEEP_DEFAULT = 0 };

typedef contest sweep; /* contestants without a kernel are the paper's test */

extern const unsigned sweep_orders[SWEEP_ORDERS];                /* the default, then the fixed ones */
extern const tribox_accuracy sweep_accuracies[SWEEP_ACCURACIES]; /* fast, conservative, exact */

/* The choices of axes that leave something out, cheapest tests first. */
extern const unsigned sweep_axes[SWEEP_AXES];

/*
 * Enters the paper's test in every fixed order and, for each kernel, all axes in every order at every accuracy, and every choice of
 * axes in the default order at EXACT. Verifies and times them. Returns NULL, or what is wrong, in a text that lasts until the next
 * call.
 */
const char *sweep_run(sweep *s, const timing_work *work, effort how, generator *turns);

/* Whether it is of this kernel or, for NULL, the paper's test. */
bool sweep_is_of(const contestant *one, const char *kernel);

/* The contestant with these options, or NULL. A kernel of NULL is the paper's test, whose accuracy is FAST and order fixed. */
const contestant *sweep_find(const sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order);

const score *sweep_score(const sweep *s, const contestant *of);

/* Nanoseconds per pair: the least of the rounds, since other work on the machine only ever adds to a time. */
double sweep_time(const sweep *s, const contestant *of);

/* Whether one is faster than another beyond the spread: by 1 % in the least time, and in three quarters of the rounds. */
bool sweep_beats(const sweep *s, const contestant *one, const contestant *other);

/* The fixed order of all axes with the least time. */
const contestant *sweep_best(const sweep *s, const char *kernel, tribox_accuracy accuracy);

/* ---- why: which axis rejects, and what is still left and loaded after each group of axes ------------------------------------- */

/* The thirteen axes: 0 to 2 the box normals x, y, z; 3 the plane; 4 + 3 i + j the edge axis e_i x f_j. */
enum { WHY_AXES = 13, WHY_PLANE = 3, WHY_EDGES = 4, WHY_ORDERS = SWEEP_ORDERS - 1, WHY_WIDTHS = 4 };

extern const unsigned *const why_orders;     /* the fixed ones */
extern const unsigned why_lanes[WHY_WIDTHS]; /* 1, 4, 8, 16 */

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

/* ---- reports: tables for people, members of a JSON object for programs, a chart ---------------------------------------------- */

/* One line: the time of the default order, with the widest kernel, beside the paper's. */
void report_best(const sweep *s);

/*
 * Nanoseconds per pair of every kernel, accuracy and order, and how the default compares; what leaving axes out gains in time and
 * costs in false reports; which axis rejects first, what is left after each group, and what is loaded, for every order.
 */
void report_tables(const sweep *s, const why *w);

/* Members "pairs", "overlapping", "axes" and "orders"; "rounds" and "entrants": what each answered, and its times. */
void report_json(json *to, const sweep *s, const why *w);

/* What follows: which order and which axes to use. */
typedef struct sweep_advice {
    const char *kernel; /* that the advice is for: the default one */
    unsigned order, axes;
    double gain;    /* the share of the default's time that it saves; 0 where nothing is faster beyond the spread */
    char text[256]; /* all of it as one sentence, without a line end */
} sweep_advice;

sweep_advice sweep_advise(const sweep *s);

/* An SVG: a panel for each kernel, a group of bars for each accuracy, a bar for each order. title, processor: above; any text. */
void sweep_chart(FILE *to, const sweep *s, const char *title, const char *processor);

#endif

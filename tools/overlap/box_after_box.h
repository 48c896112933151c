/*
 * box_after_box.h - asks one mesh about box after box, without knowing how many will come: tests every triangle, builds an index
 * when it has paid as much for tests, and puts the mesh in order for it when it has paid as much again. So a file of boxes takes at
 * most about twice what it would take if the number were known. Answers are the same each way.
 */
#ifndef BOX_AFTER_BOX_H
#define BOX_AFTER_BOX_H

#include "read/mesh.h"
#include "report.h"

typedef struct box_after_box {
    const request *r;
    mesh *m;
    index_stage stage, last; /* the last that can be reached */
    double seconds;          /* of the tests at this stage */
    masks bits;              /* of tests without an index */
    tribox_index index;
    void *nodes;       /* of the index */
    uint32_t *order;   /* the number in the file of each triangle; NULL until the mesh is in order */
    found_words words; /* with --list */
} box_after_box;

/* Returns an exit_code; on success box_after_box_end gives back what this and the questions have taken, but not the mesh. */
int box_after_box_start(const request *r, mesh *m, box_after_box *b);

/* Answers a->box. Returns an exit_code. */
int box_after_box_ask(box_after_box *b, answer *a);

/* Prints the list of the last answer. Returns an exit_code. */
int box_after_box_list(const box_after_box *b, answer *a);

void box_after_box_end(box_after_box *b);

#endif

/*
 * many_boxes.h - asks one mesh about box after box, without knowing how many will come: tests every triangle, builds an index when
 * it has paid as much for tests, and puts the mesh in order for it when it has paid as much again. So a file of boxes takes at most
 * about twice what it would take if the number were known. Answers are the same each way.
 */
#ifndef MANY_BOXES_H
#define MANY_BOXES_H

#include "found_words.h"
#include "overlap.h"
#include "read/mesh.h"

typedef struct many_boxes {
    const request *r;
    mesh *m;
    index_stage stage, last; /* the last that can be reached */
    double seconds;          /* of the tests at this stage */
    masks bits;              /* of tests without an index */
    tribox_index index;
    void *nodes;       /* of the index */
    uint32_t *order;   /* the number in the file of each triangle; NULL until the mesh is in order */
    found_words words; /* with --list */
} many_boxes;

/* Returns an exit_code; on success many_boxes_end gives back what this and the questions have taken, but not the mesh. */
int many_boxes_start(const request *r, mesh *m, many_boxes *b);

/* Answers a->box. Returns an exit_code. */
int many_boxes_ask(many_boxes *b, answer *a);

/* Prints the list of the last answer. Returns an exit_code. */
int many_boxes_list(const many_boxes *b, answer *a);

void many_boxes_end(many_boxes *b);

#endif

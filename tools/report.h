/* report.h - what tribox overlap was asked, what it found, and how it prints that. */
#ifndef REPORT_H
#define REPORT_H

#include <stdbool.h>

#include "mesh.h"

/* What was asked. */
typedef struct request {
    const char *mesh_path;
    const char *box_text;   /* NULL with boxes_path */
    tribox_box box;         /* what box_text says */
    const char *boxes_path; /* NULL with box_text */
    tribox_options test;
    bool wants_list, wants_json, wants_help;
} request;

/* One box and what was found out about it. */
typedef struct answer {
    tribox_box box;
    size_t line; /* of the boxes file; 0 with --box */
    tribox_report report;
    int runs;
    double seconds; /* of the best run */
} answer;

/* Prints an answer in the form that was asked for, and writes it out. Returns an exit_code. mask: of the triangles. */
int report_print(const mesh *m, const request *r, const answer *a, const uint64_t *mask);

#endif

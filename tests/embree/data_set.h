/* data_set.h - a data set, every kernel and accuracy: the library against the witnesses, and its voxels against its pairs. */
#ifndef TRIBOX_TESTS_DATA_SET_H
#define TRIBOX_TESTS_DATA_SET_H

#include "embree_planes.h"

typedef struct data_set {
    const char *name;
    model model;
    tribox_grid grid;
    bool is_exact; /* small integers of one unit: then nobody may err, FAST neither */
} data_set;

void data_set_print_heading(void);

/* Fails the cmocka test at hand, with the pair in hexadecimal floats; else prints a line of counts. */
void data_set_check(data_set *d, uint64_t seed);

#endif

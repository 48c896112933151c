/* check.h - one data set, every kernel and every accuracy: the library against the witnesses, and its voxels against its pairs. */
#ifndef TRIBOX_TESTS_CHECK_H
#define TRIBOX_TESTS_CHECK_H

#include "planes.h"

typedef struct data_set {
    const char *name;
    shape shape;
    tribox_grid grid;
    bool is_exact; /* small integers of one unit: then nobody may err, FAST neither */
} data_set;

void check_print_heading(void);

/* Fails the cmocka test at hand, with the pair in hexadecimal floats; else prints a line of counts. */
void check_data_set(data_set *d, uint64_t seed);

#endif

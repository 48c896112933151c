/* sort_first.h - the triangles of a mesh that is larger than memory, sorted into a partition that is gone when it was used. */
#ifndef SORT_FIRST_H
#define SORT_FIRST_H

#include "partition/partition_make.h"
#include "voxelize_work.h"

/* Where it lies. */
typedef struct sorted_place {
    const voxelize_request *r;
    char *path, *told;
    folder_out pipe; /* the triangles of a pipe, until they are sorted */
    partition_answer made;
} sorted_place;

/* Whether the answer would be the same. */
bool sort_first_can(const voxelize_request *r);

/* Whether a file is larger than memory is to hold, and can be sorted. Returns an exit_code. */
int sort_first_is_due(const voxelize_request *r, bool *is_due);

/* Of a pipe this is found while it is read. The place is made, and to be dropped. */
mesh_overflow sort_first_overflow(const voxelize_request *r, sorted_place *p);

/* Sorts the file, or what came of the pipe: the partition is made.out.beside. Returns an exit_code; dropping is due in any case. */
int sort_first(sorted_place *p);
void sort_first_drop(sorted_place *p);

#endif

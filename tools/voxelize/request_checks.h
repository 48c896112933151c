/* request_checks.h - the options of tribox voxelize, and which of them go together. */
#ifndef REQUEST_CHECKS_H
#define REQUEST_CHECKS_H

#include "voxelize_work.h"

/* Behind those that merge has too. */
enum {
    OPTION_GRID = RESULT_END,
    OPTION_COUNT = OPTION_GRID + GRID_END,
    OPTION_THIN,
    OPTION_FILL,
    OPTION_LABELS,
    OPTION_INSIDE_ONLY,
    OPTION_COLOURS,
    OPTION_IDS,
    OPTION_THREADS,
    OPTION_SHARD,
    OPTION_ACCURACY,
    OPTION_AXES,
    OPTION_KERNEL
};

/* What every command line needs, and what excludes each other; options: their names. Finds the format. Returns an exit_code. */
int request_check(voxelize_request *r, const options_found *found, const option_entry *options);

#endif

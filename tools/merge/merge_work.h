/* merge_work.h - a request of tribox merge, and the work that answers it. */
#ifndef MERGE_WORK_H
#define MERGE_WORK_H

#include "voxelize/result_options.h"

typedef struct merge_request {
    const char **parts; /* paths, with room for all words */
    size_t count;
    uint32_t threads;
    result_request result;
} merge_request;

/* From the parts to the file and the summary. Returns an exit_code. */
int merge_work(const merge_request *request);

#endif

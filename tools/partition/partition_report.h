/* partition_report.h - what tribox partition did, for people and as JSON. */
#ifndef PARTITION_REPORT_H
#define PARTITION_REPORT_H

#include "partition.h"
#include "partition_work.h"

typedef struct partition_answer {
    const partition_request *r;
    voxels cells;
    bool is_shifted;
    partition_header header;
    uint64_t spilled; /* bytes that went through files beside it */
    double seconds;
} partition_answer;

/* Prints the answer and flushes the output. Returns an exit_code. */
int partition_report(const partition_answer *a);

#endif

/* header.h - what every report begins with: without it a figure says nothing. */
#ifndef BENCH_HEADER_H
#define BENCH_HEADER_H

#include <stdint.h>
#include <stdio.h>

#include "console/json.h"
#include "machine.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct run {
    int argc;
    char **argv;
    uint64_t seed;
    machine on;
} run;

/* Processor, compiler, flags, commit, command, seed and limits, a line each; `mark` starts each line. */
void header_text(FILE *to, const char *mark, const run *r);

/* The same as members of a JSON object that the caller has opened. */
void header_json(json *to, const run *r);

#ifdef __cplusplus
}
#endif

#endif

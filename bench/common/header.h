/* header.h - what every report begins with: without it a figure says nothing. */
#ifndef BENCH_HEADER_H
#define BENCH_HEADER_H

#include <stdint.h>
#include <stdio.h>

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

/** Processor, compiler, flags, commit, command, seed and limits, a line each; `mark` in front of each line. */
void header_text(FILE *to, const char *mark, const run *r);

/** The same as members of a JSON object whose brace the caller has opened; no comma behind the last. */
void header_json(FILE *to, const run *r);

/** The text in quotes, as JSON wants it. */
void json_string(FILE *to, const char *text);

#ifdef __cplusplus
}
#endif

#endif

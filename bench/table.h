/* table.h - prints what was measured: a table for people, or JSON. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "machine.h"
#include "measure.h"

typedef struct run {
    int argc;
    char **argv;
    uint64_t seed;
    machine on;
} run;

typedef struct result {
    const scene *at;
    const contestant *list;
    const score *scores;
    const samples *taken;
} result;

void table_begin(const run *r);
void table_scene(const result *r);

void json_begin(const run *r);
void json_scene(const result *r, bool is_first);
void json_end(void);

#endif

/* table.h - prints what was measured: a table for people, or JSON. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "header.h"
#include "measure.h"

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

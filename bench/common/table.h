/* table.h - prints what was measured of a scene: a table for people, or JSON. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "entries.h"
#include "header.h"
#include "soups.h"

/* The paper's test is the first of the list. */
typedef struct result {
    const scene *at;
    const contestant *list;
    const score *scores;
    const samples *taken;
} result;

void table_scene(const result *r);

/* A member of an array of scenes. */
void table_json(json *to, const result *r);

#endif

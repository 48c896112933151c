/* trade.h - what accuracy costs and what it buys: a table for people, CSV and JSON. */
#ifndef BENCH_TRADE_H
#define BENCH_TRADE_H

#include <stdio.h>

#include "common/header.h"
#include "stages.h"

/** One scene and one choice of axes: what everyone answered, in which time. */
typedef struct trade {
    const scene *at;  /* the first of the scenes, which share a soup */
    size_t scenes;    /* as many boxes */
    const char *axes; /* "all", "box+plane", ... */
    const contestant *list;
    const score *scores; /* summed over the scenes */
    const stages *apart; /* of the kernels at CONSERVATIVE and EXACT */
    const samples *taken;
} trade;

/** The table: of all axes a row for each contestant, of other axes for the widest kernel alone. */
void trade_table_scene(const trade *t);
void trade_table(const trade *t);

/** CSV: lines with a # tell of the machine, the next one names the columns. What was not measured is empty. */
void trade_csv_begin(FILE *to, const run *r);
void trade_csv(FILE *to, const trade *t, bool is_first);

/** JSON: an object with the machine and "rows", each an object with the columns of the CSV. What was not measured is null. */
void trade_json_begin(FILE *to, const run *r);
void trade_json(FILE *to, const trade *t, bool is_first);
void trade_json_end(FILE *to);

#endif

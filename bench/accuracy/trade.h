/* trade.h - what accuracy costs and what it buys: a table for people, CSV and JSON. */
#ifndef BENCH_TRADE_H
#define BENCH_TRADE_H

#include "common/entries.h"
#include "common/header.h"
#include "common/soups.h"

/* One scene and one choice of axes: what everyone answered, in which time. */
typedef struct trade {
    const scene *at;
    const char *axes; /* "all", "box+plane", ... */
    const contestant *list;
    const score *scores;
    const samples *taken;
} trade;

/* The table: with all axes a row for each contestant, with other axes for the widest kernel alone. */
void trade_table_scene(const trade *t);
void trade_table(const trade *t);

/* CSV: lines with a # describe the machine, the next one names the columns. What was not measured is empty. */
void trade_csv_begin(FILE *to, const run *r);
void trade_csv(FILE *to, const trade *t, bool is_first);

/* Objects with the columns of the CSV, in the array that is open. What was not measured is null. */
void trade_json(json *to, const trade *t);

#endif

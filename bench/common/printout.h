/*
 * printout.h - the one output of all benchmarks: on what was measured, then tables. A row is told column by column, and printed as
 * text, as JSON or as CSV, whose names of columns are the same; in text a line stands for a space.
 */
#ifndef BENCH_PRINTOUT_H
#define BENCH_PRINTOUT_H

#include <math.h>
#include <stdio.h>

#include "console/json.h"
#include "timing/timing.h"

typedef struct printout_column {
    const char *name, *text; /* NULL for a number, NAN where there is none */
    double number;
    int decimals;
    bool is_data; /* not in the text */
} printout_column;

enum { PRINTOUT_COLUMNS = 40, PRINTOUT_LINE = 512 };

typedef struct printout {
    bool is_json, is_table_open, has_rows;
    json to;
    FILE *csv; /* NULL for none */
    char csv_head[1024];
    char command[PRINTOUT_LINE];
    printout_column row[PRINTOUT_COLUMNS];
    size_t columns;
} printout;

/* Keeps the command line, which is asked before options are read: that moves words of it. */
void printout_keep_command(printout *r, int argc, char **argv);

/* Processor, compiler, flags, commit, command, seed, kernel and limits. Without them a figure says nothing. */
void printout_begin(printout *r, uint64_t seed, const char *kernel);
void printout_end(printout *r);

/* The title of a table, in a line; rows follow. */
__attribute__((format(printf, 2, 3))) void printout_table(printout *r, const char *title, ...);

/*
 * ADD adds columns to a row, of these: a text, a number with so many decimals, which may not be there, and the same for JSON and
 * CSV alone. ROW also completes it. Names and texts are used until then.
 */
#define TEXT(name, text) ((printout_column){name, text, NAN, 0, false})
#define NUMBER(name, decimals, number) ((printout_column){name, NULL, (double)(number), decimals, false})
#define NUMBER_IF(is_there, name, decimals, number) NUMBER(name, decimals, (is_there) ? (double)(number) : (double)NAN)
#define TEXT_DATA(name, text) ((printout_column){name, text, NAN, 0, true})
#define DATA(name, number) ((printout_column){name, NULL, (double)(number), 6, true})
#define ADD(r, ...) printout_add(r, (const printout_column[]){__VA_ARGS__, {.name = NULL}})
#define ROW(r, ...) (ADD(r, __VA_ARGS__), printout_row(r))

void printout_add(printout *r, const printout_column *columns); /* the last one has no name */

/* The median and the least time of a contestant; in JSON and CSV the quartiles, too. */
void printout_times(printout *r, const samples *taken, size_t c);

/* The row is complete. */
void printout_row(printout *r);

/* A line below the table. */
__attribute__((format(printf, 2, 3))) void printout_note(printout *r, const char *text, ...);

/* Says so where other work took turns on the core: a quiet machine repeats a contestant to a few percent. */
void printout_disturbed(printout *r, const samples *taken);

#endif

/* order_report.h - prints what a sweep measured, and why: tables for people, members of a JSON object for programs. */
#ifndef ORDER_REPORT_H
#define ORDER_REPORT_H

#include <stdio.h>

#include "console/json.h"
#include "order_sweep.h"
#include "order_why.h"

/* One line: the time of the default order, with the widest kernel, beside the paper's. */
void report_best(FILE *to, const sweep *s);

/* Nanoseconds per pair of every kernel, accuracy and order, and how the default compares. */
void report_times(FILE *to, const sweep *s);

/* What leaving axes out gains in time and costs in false reports. */
void report_axes(FILE *to, const sweep *s, const why *w);

/* Which axis rejects first, what is left after each group, and what is loaded, for every order. */
void report_why(FILE *to, const why *w);

/* Members "rounds" and "entrants": what each answered, and the nanoseconds per pair of each round. */
void report_json_sweep(json *to, const sweep *s);

/* Members "pairs", "overlapping", "axes" and "orders". */
void report_json_why(json *to, const why *w);

#endif

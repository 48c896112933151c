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

/* What follows: which order and which axes to use. */
typedef struct sweep_advice {
    const char *kernel; /* that the advice is for: the default one */
    unsigned order, axes;
    double gain; /* the share of the default's time that it saves; 0 where nothing is faster beyond the spread */
} sweep_advice;

sweep_advice sweep_advise(const sweep *s);

/* The advice as one sentence, without a line end. */
void sweep_advice_text(const sweep_advice *advice, char *text, size_t size);

#endif

/*
 * sweep_chart.h - draws a sweep as an SVG file: a panel for each kernel, a group of bars for each accuracy, a bar for each order.
 */
#ifndef SWEEP_CHART_H
#define SWEEP_CHART_H

#include <stdio.h>

#include "order_sweep.h"

/* title: one line above the panels; any text. */
void sweep_chart(FILE *to, const sweep *s, const char *title);

#endif

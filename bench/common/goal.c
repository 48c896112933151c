/* goal.c - prints goals. */
#include "goal.h"

#include <stdio.h>

bool goal_is_reached(const goal *g) { return g->is_most ? g->reached <= g->goal : g->reached >= g->goal; }

void goal_print(const goal *g)
{
    printf("%-62s %-8s %8.5g  %-11s %8.4g\n", g->what, g->is_most ? "at most" : "at least", g->goal,
           goal_is_reached(g) ? "reached" : "NOT reached", g->reached);
}

/* paper.c - chooses among the compilations of the paper's test. */
#include "paper.h"

#include <stdbool.h>

#if defined(PAPER_X86)
static bool runs_avx2(void) { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

static bool runs_avx512(void)
{
    return runs_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
}
#endif

static bool runs_any(void) { return true; }

/* Widest first. */
static const struct {
    const char *name;
    bool (*runs_here)(void);
    paper_walk *const *walks;
} compilations[] = {
#if defined(PAPER_X86)
    {"avx512", runs_avx512, paper_walks_avx512},
    {"avx2", runs_avx2, paper_walks_avx2},
#endif
    {"any", runs_any, paper_walks_any},
};

static size_t choose(void)
{
    size_t chosen = 0;
    while (!compilations[chosen].runs_here())
        chosen++;
    return chosen;
}

const char *paper_instruction_set(void) { return compilations[choose()].name; }

paper_walk *paper_in_order(unsigned order)
{
    static const unsigned orders[PAPER_ORDERS] = {123, 132, 213, 231, 312, 321};
    size_t o = 0;
    while (o + 1 < PAPER_ORDERS && orders[o] != order)
        o++;
    return compilations[choose()].walks[o];
}

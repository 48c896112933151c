/*
 * claims.h - what was counted, beside what PROOFS.md states.
 *
 * Usage of a program: PROGRAM PROOFS.md [explain]. A claim is a row of the table in PROOFS.md 3.8: its name, its section, the
 * unit, and the count without and with fused operations. The program fails unless what it counts is that number, and each bound that the texts
 * take covers the error that it is for. `explain` shows where the worst case is rounded.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if !defined(V_FUSED)
#define V_FUSED 0
#endif

static const char *claims_file, *claims_unit = V_FUSED ? "fused" : "unfused";
static bool claims_explain;
static int claims_wrong;

static inline double most_of(double a, double b) { return a > b ? a : b; }

/* The cell of a row, from `at` on; the next one is returned. */
static inline char *claims_cell(char *at, char *cell, size_t room)
{
    at += strspn(at, " ");
    const size_t length = strcspn(at, "|");
    size_t copied = length < room ? length : room - 1;
    memcpy(cell, at, copied);
    while (copied && cell[copied - 1] == ' ')
        copied--;
    cell[copied] = 0;
    return at[length] ? at + length + 1 : at + length;
}

/* The number in the row of this name: NAN if there is none. */
static inline double claims_stated(const char *name)
{
    char line[512], cell[5][128];
    double stated = NAN;
    FILE *const file = fopen(claims_file, "r");
    if (!file) {
        fprintf(stderr, "cannot open %s: name PROOFS.md\n", claims_file);
        exit(1);
    }
    while (fgets(line, sizeof line, file)) {
        char *at = line + 1;
        if (line[0] != '|')
            continue;
        for (int k = 0; k < 5; k++)
            at = claims_cell(at, cell[k], sizeof cell[k]);
        if (!strcmp(cell[0], name))
            stated = strtod(cell[V_FUSED ? 4 : 3], NULL);
    }
    fclose(file);
    return stated;
}

/* Needed is what was counted, rounded up to hundredths but for what the count itself rounds, and for second orders in constants. */
static inline void claim(const char *name, double needed, double of_bound)
{
    const double stated = claims_stated(name), rounded = ceil(needed * 100 - 0.05) / 100;
    const bool is_stated = fabs(stated - rounded) < 1e-9, is_covered = of_bound < 1;
    printf("%-32s %7.4g", name, rounded);
    if (of_bound > 0)
        printf("   %.4f of the bound%s", of_bound, is_covered ? "" : ": TOO MUCH");
    if (!is_stated)
        printf("   PROOFS.md states %g, %s", stated, claims_unit);
    printf("\n");
    claims_wrong += !is_stated || !is_covered;
}

static inline void claims_start(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: %s PROOFS.md [explain]\n", argv[0]);
        exit(1);
    }
    claims_file = argv[1];
    claims_explain = argc > 2 && !strcmp(argv[2], "explain");
    printf("%s, u = %g\n", claims_unit, (double)V_UNIT);
}

static inline int claims_end(void)
{
    if (claims_wrong)
        printf("%d wrong\n", claims_wrong);
    return claims_wrong != 0;
}

/*
 * claims.h - what was counted, against what PROOFS.md states.
 *
 * Usage of a program: PROGRAM PROOFS.md [explain]. A claim is a row of the table in PROOFS.md 3.8: its name, its section, the
 * unit, and the count without and with fused operations. The program fails unless what it counts is that number, and each bound
 * that the texts take covers the error that it is for. `explain` shows where the worst case is rounded.
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

/* A number, or 2^n. */
static inline double claims_number(const char *cell)
{
    return strncmp(cell, "2^", 2) ? strtod(cell, NULL) : exp2(strtod(cell + 2, NULL));
}

/* What was counted, what it is of the bound, and what the text takes; 0 where there is no bound. */
typedef struct count_claim {
    const char *name;
    double needed, of_bound, taken;
} count_claim;

/* What the row of this name states: NAN where there is none. */
static inline count_claim claims_stated(const char *name)
{
    char line[512], cell[6][128];
    count_claim stated = {name, NAN, NAN, NAN};
    FILE *const file = fopen(claims_file, "r");
    if (!file) {
        fprintf(stderr, "cannot open %s: name PROOFS.md\n", claims_file);
        exit(1);
    }
    while (fgets(line, sizeof line, file)) {
        char *at = line + 1;
        if (line[0] != '|')
            continue;
        for (int k = 0; k < 6; k++)
            at = claims_cell(at, cell[k], sizeof cell[k]);
        if (strcmp(cell[0], name) != 0)
            continue;
        stated.needed = strtod(cell[V_FUSED ? 4 : 3], NULL);
        stated.taken = claims_number(cell[5]);
    }
    fclose(file);
    return stated;
}

/*
 * Needed is what was counted, rounded up to hundredths but for what the count itself rounds, and for second orders in constants. A
 * row says what is taken if and only if the text takes something; a power of two is stated to a tenth.
 */
static inline void claim(const count_claim *of)
{
    const count_claim stated = claims_stated(of->name);
    const double needed = ceil(of->needed * 100 - 0.05) / 100;
    const bool is_stated = fabs(stated.needed - needed) < 1e-9, is_covered = of->of_bound < 1;
    const bool is_taken =
        of->taken > 0 ? fabs(stated.taken / of->taken - 1) < (stated.taken < 1024 ? 0.01 : 0.035) : !(stated.taken > 0);
    printf("%-32s %7.4g", of->name, needed);
    if (of->of_bound > 0)
        printf("   %.4g of the bound%s", of->of_bound, is_covered ? "" : ": TOO MUCH");
    if (!is_stated)
        printf("   PROOFS.md states %g, %s", stated.needed, claims_unit);
    if (!is_taken)
        printf("   taken is %g, PROOFS.md states %g", of->taken, stated.taken);
    printf("\n");
    claims_wrong += !is_stated || !is_covered || !is_taken;
}

static inline void claim_number(const char *name, double needed) { claim(&(count_claim){name, needed, 0, 0}); }
static inline void claim_taken(const char *name, double needed, double taken)
{
    claim(&(count_claim){name, needed, needed / taken, taken});
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

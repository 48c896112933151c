#include "trade.h"

#include <math.h>
#include <string.h>

static size_t pairs_of(const trade *t) { return t->at->soup.count * t->scenes; }

static double share_of(size_t part, size_t of, double unit) { return of ? unit * (double)part / (double)of : NAN; }

/* Whether a contestant has stages: FAST and the baseline are one. */
static bool is_staged(const contestant *one) { return one->kind == CONTESTANT_KERNEL && one->options.accuracy != TRIBOX_FAST; }

static const char *kernel_of(const contestant *one) { return one->kind == CONTESTANT_KERNEL ? one->options.kernel : one->name; }

static const char *accuracy_of(const contestant *one)
{
    const char *const dash = one->kind == CONTESTANT_KERNEL ? strchr(one->name, '-') : NULL;
    return dash ? dash + 1 : one->name;
}

/* A column of a row: a text, or else a number, NAN for none. */
typedef struct column {
    const char *name, *text;
    double number;
} column;

enum { COLUMNS_MAX = 32 };

typedef struct row {
    size_t count;
    column of[COLUMNS_MAX];
} row;

static void add_text(row *r, const char *name, const char *text) { r->of[r->count++] = (column){name, text, NAN}; }

static void add_number(row *r, const char *name, double number) { r->of[r->count++] = (column){name, NULL, number}; }

static void add_errors(row *r, const score *s, size_t pairs)
{
    add_number(r, "overlap_percent", share_of(s->overlapping, pairs, 100));
    add_number(r, "missed_per_million", share_of(s->of_accuracy.missed, pairs, 1e6));
    add_number(r, "untrue_per_million", share_of(s->of_accuracy.untrue, pairs, 1e6));
    add_number(r, "missed_per_million_of_all_axes", share_of(s->of_all.missed, pairs, 1e6));
    add_number(r, "untrue_per_million_of_all_axes", share_of(s->of_all.untrue, pairs, 1e6));
}

static void add_stages(row *r, const stages *s)
{
    add_number(r, "left_by_float_percent", s ? share_of(s->left_by_float, s->pairs, 100) : NAN);
    add_number(r, "left_by_double_percent", s ? share_of(s->left_by_double, s->pairs, 100) : NAN);
    add_number(r, "walk_ns_per_triangle", s ? s->walk : NAN);
    add_number(r, "settle_ns_per_pair_left", s ? s->settle : NAN);
    add_number(r, "double_ns_per_pair_left", s ? s->in_double : NAN);
    add_number(r, "integers_ns_per_pair_left", s ? s->integers : NAN);
    add_number(r, "int64_ns", s ? s->width[WIDTH_INT64] : NAN);
    add_number(r, "int128_ns", s ? s->width[WIDTH_INT128] : NAN);
    add_number(r, "limbs_ns", s ? s->width[WIDTH_LIMBS] : NAN);
}

static row row_of(const trade *t, size_t c)
{
    const contestant *const one = &t->list[c];
    const size_t fast = contest_fast_of(t->list, t->taken->contestants, c);
    const spread ns = measure_spread(t->taken, c), slower = measure_ratio(t->taken, c, fast);
    const bool has_fast = one->kind == CONTESTANT_KERNEL;
    row r = {.count = 0};
    add_text(&r, "scene", t->at->name);
    add_number(&r, "triangles", (double)t->at->soup.count);
    add_number(&r, "boxes", (double)t->scenes);
    add_text(&r, "axes", t->axes);
    add_text(&r, "kernel", kernel_of(one));
    add_text(&r, "accuracy", accuracy_of(one));
    add_number(&r, "rounds", (double)t->taken->rounds);
    add_number(&r, "ns_least", ns.least);
    add_number(&r, "ns_lower_quartile", ns.lower_quartile);
    add_number(&r, "ns_median", ns.median);
    add_number(&r, "ns_upper_quartile", ns.upper_quartile);
    add_number(&r, "times_fast_lower_quartile", has_fast ? slower.lower_quartile : NAN);
    add_number(&r, "times_fast_median", has_fast ? slower.median : NAN);
    add_number(&r, "times_fast_upper_quartile", has_fast ? slower.upper_quartile : NAN);
    add_errors(&r, &t->scores[c], pairs_of(t));
    add_stages(&r, is_staged(one) ? &t->apart[c] : NULL);
    return r;
}

void trade_csv_begin(FILE *to, const run *r) { header_text(to, "# ", r); }

static void csv_row(FILE *to, const row *r, bool is_head)
{
    for (size_t k = 0; k < r->count; k++) {
        const column *const of = &r->of[k];
        fprintf(to, k ? "," : "");
        if (is_head)
            fprintf(to, "%s", of->name);
        else if (of->text)
            fprintf(to, "%s", of->text);
        else if (!isnan(of->number))
            fprintf(to, "%.7g", of->number);
    }
    fprintf(to, "\n");
}

void trade_csv(FILE *to, const trade *t, bool is_first)
{
    for (size_t c = 0; c < t->taken->contestants; c++) {
        const row r = row_of(t, c);
        if (is_first && c == 0)
            csv_row(to, &r, true);
        csv_row(to, &r, false);
    }
    fflush(to);
}

void trade_json_begin(FILE *to, const run *r)
{
    fprintf(to, "{");
    header_json(to, r);
    fprintf(to, ",\n \"rows\": [");
}

void trade_json(FILE *to, const trade *t, bool is_first)
{
    for (size_t c = 0; c < t->taken->contestants; c++) {
        const row r = row_of(t, c);
        fprintf(to, "%s\n  {", is_first && c == 0 ? "" : ",");
        for (size_t k = 0; k < r.count; k++) {
            const column *const of = &r.of[k];
            fprintf(to, "%s\"%s\": ", k ? ", " : "", of->name);
            if (of->text)
                json_string(to, of->text);
            else if (isnan(of->number))
                fprintf(to, "null");
            else
                fprintf(to, "%.7g", of->number);
        }
        fprintf(to, "}");
    }
    fflush(to);
}

void trade_json_end(FILE *to) { fprintf(to, "\n ]}\n"); }

void trade_table_scene(const trade *t)
{
    printf("\nscene %s: %zu triangles, %s; ", t->at->name, t->at->soup.count, t->at->what);
    if (t->scenes > 1)
        printf("%zu boxes\n", t->scenes);
    else
        printf("box [%.8g, %.8g]^3\n", (double)t->at->box.lo[0], (double)t->at->box.hi[0]);
    printf("%-31s %15s %7s  %26s  %19s  %-42s\n", "", "ns per triangle", "times", "a million pairs", "left, percent", "ns");
    printf("%-11s %-19s %7s %7s %7s  %8s %8s %8s  %9s %9s  %6s %6s %6s %8s %6s %6s %6s\n", "axes", "contestant", "median", "least",
           "fast", "missed", "untrue", "extra", "by float", "by double", "walk", "settle", "double", "integers", "int64", "int128",
           "limbs");
}

/* A number in `width` columns, or a dash where there is none. */
static void print_number(double number, int width, int decimals)
{
    if (isnan(number))
        printf(" %*s", width, "-");
    else
        printf(" %*.*f", width, decimals, number);
}

static void print_stages(const stages *s)
{
    print_number(s ? share_of(s->left_by_float, s->pairs, 100) : NAN, 10, 4);
    print_number(s ? share_of(s->left_by_double, s->pairs, 100) : NAN, 9, 4);
    print_number(s ? s->walk : NAN, 7, 2);
    print_number(s ? s->settle : NAN, 6, 1);
    print_number(s ? s->in_double : NAN, 6, 1);
    print_number(s ? s->integers : NAN, 8, 1);
    for (int w = 0; w < WIDTHS; w++)
        print_number(s ? s->width[w] : NAN, 6, 0);
    printf("\n");
}

static void print_row(const trade *t, size_t c)
{
    const contestant *const one = &t->list[c];
    const size_t fast = contest_fast_of(t->list, t->taken->contestants, c), pairs = pairs_of(t);
    const spread ns = measure_spread(t->taken, c);
    const score *const s = &t->scores[c];
    printf("%-11s %-19s", t->axes, one->name);
    print_number(ns.median, 7, 3);
    print_number(ns.least, 7, 3);
    print_number(fast == c ? NAN : measure_ratio(t->taken, c, fast).median, 7, 2);
    print_number(share_of(s->of_accuracy.missed, pairs, 1e6), 9, 1);
    print_number(share_of(s->of_accuracy.untrue, pairs, 1e6), 8, 1);
    print_number(share_of(s->of_all.untrue, pairs, 1e6), 8, 0);
    print_stages(is_staged(one) ? &t->apart[c] : NULL);
}

/* What the project set out to reach, in times the time of FAST of the same kernel. */
static const struct goal {
    const char *scene, *contestant;
    double most;
} goals[] = {
    {"paper", "avx2-exact", 1.10},   {"paper", "avx2-conservative", 1.10},
    {"paper", "avx512-exact", 1.10}, {"paper", "avx512-conservative", 1.10},
    {"cad", "avx2-exact", 2},        {"cad", "avx512-exact", 2},
    {"cad-tenths", "avx2-exact", 2}, {"cad-tenths", "avx512-exact", 2},
    {"touching", "avx2-exact", 12},  {"touching", "avx512-exact", 12},
};

static void print_goals(const trade *t, size_t c)
{
    for (size_t g = 0; g < sizeof goals / sizeof goals[0]; g++) {
        if (strcmp(goals[g].scene, t->at->name) != 0 || strcmp(goals[g].contestant, t->list[c].name) != 0)
            continue;
        const size_t fast = contest_fast_of(t->list, t->taken->contestants, c);
        const double slower = measure_ratio(t->taken, c, fast).median;
        const double by_least = measure_spread(t->taken, c).least / measure_spread(t->taken, fast).least;
        printf("goal: %s at most %.2f times fast: %s, %.2f (by least %.2f)\n", goals[g].contestant, goals[g].most,
               slower <= goals[g].most ? "reached" : "NOT reached", slower, by_least);
    }
}

void trade_table(const trade *t)
{
    const bool is_all = !strcmp(t->axes, "all");
    const char *const widest = kernel_of(&t->list[t->taken->contestants > 1 && t->list[0].kind != CONTESTANT_KERNEL]);
    for (size_t c = 0; c < t->taken->contestants; c++)
        if (is_all || !strcmp(kernel_of(&t->list[c]), widest))
            print_row(t, c);
    for (size_t c = 0; is_all && c < t->taken->contestants; c++)
        print_goals(t, c);
    if (is_all)
        measure_warn_if_disturbed(t->taken);
    fflush(stdout);
}

/* trade.c - the reports of accuracy. */
#include "trade.h"

#include <math.h>
#include <string.h>

#include "console/accuracy.h"

static double share_of(size_t part, size_t of, double unit) { return of ? unit * (double)part / (double)of : NAN; }

static const char *kernel_of(const contestant *one) { return one->options.kernel ? one->options.kernel : one->name; }

static const char *accuracy_of(const contestant *one)
{
    return one->options.kernel ? accuracy_word(one->options.accuracy) : one->name;
}

/* What a pair that float leaves undecided costs beyond a pair that it decides, in nanoseconds; NAN where there are next to none. */
static double undecided_ns(const trade *t, size_t c)
{
    const double share = (double)t->scores[c].undecided / (double)t->at->work.pairs, least_share = 5e-3;
    const size_t fast = entry_fast_of(t->list, t->taken->contestants, c);
    if (fast == c || share < least_share)
        return NAN;
    return (measure_spread(t->taken, c).least - measure_spread(t->taken, fast).least) / share;
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

static row row_of(const trade *t, size_t c)
{
    const contestant *const one = &t->list[c];
    const size_t fast = entry_fast_of(t->list, t->taken->contestants, c);
    const spread ns = measure_spread(t->taken, c), slower = measure_ratio(t->taken, c, fast);
    const bool has_fast = one->options.kernel;
    row r = {.count = 0};
    add_text(&r, "scene", t->at->name);
    add_number(&r, "triangles", (double)t->at->work.jobs[0].soup.count);
    add_number(&r, "boxes", (double)t->at->work.count);
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
    add_errors(&r, &t->scores[c], t->at->work.pairs);
    add_number(&r, "undecided_percent", has_fast ? share_of(t->scores[c].undecided, t->at->work.pairs, 100) : NAN);
    add_number(&r, "ns_per_undecided_pair", undecided_ns(t, c));
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

void trade_json(json *to, const trade *t)
{
    for (size_t c = 0; c < t->taken->contestants; c++) {
        const row r = row_of(t, c);
        json_open_object(to, NULL);
        for (size_t k = 0; k < r.count; k++)
            if (r.of[k].text)
                json_string(to, r.of[k].name, r.of[k].text);
            else
                json_number(to, r.of[k].name, 7, r.of[k].number);
        json_close(to);
    }
    fflush(to->to);
}

void trade_table_scene(const trade *t)
{
    const tribox_box *const box = &t->at->work.jobs[0].box;
    printf("\nscene %s: %zu triangles, %s; ", t->at->name, t->at->work.jobs[0].soup.count, t->at->what);
    if (t->at->work.count > 1)
        printf("%zu boxes\n", t->at->work.count);
    else
        printf("box [%.8g, %.8g]^3\n", (double)box->lo[0], (double)box->hi[0]);
    printf("%-31s %15s %7s  %26s  %18s\n", "", "ns per triangle", "times", "a million pairs", "undecided");
    printf("%-11s %-19s %7s %7s %7s  %8s %8s %8s  %9s %8s\n", "axes", "contestant", "median", "least", "fast", "missed", "untrue",
           "extra", "percent", "ns each");
}

/* A number in `width` columns, or a dash where there is none. */
static void print_number(double number, int width, int decimals)
{
    if (isnan(number))
        printf(" %*s", width, "-");
    else
        printf(" %*.*f", width, decimals, number);
}

static void print_row(const trade *t, size_t c)
{
    const contestant *const one = &t->list[c];
    const size_t fast = entry_fast_of(t->list, t->taken->contestants, c), pairs = t->at->work.pairs;
    const spread ns = measure_spread(t->taken, c);
    const score *const s = &t->scores[c];
    printf("%-11s %-19s", t->axes, one->name);
    print_number(ns.median, 7, 3);
    print_number(ns.least, 7, 3);
    print_number(fast == c ? NAN : measure_ratio(t->taken, c, fast).median, 7, 2);
    print_number(share_of(s->of_accuracy.missed, pairs, 1e6), 9, 1);
    print_number(share_of(s->of_accuracy.untrue, pairs, 1e6), 8, 1);
    print_number(share_of(s->of_all.untrue, pairs, 1e6), 8, 0);
    print_number(one->options.kernel ? share_of(s->undecided, pairs, 100) : NAN, 10, 4);
    print_number(undecided_ns(t, c), 8, 1);
    printf("\n");
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
        const size_t fast = entry_fast_of(t->list, t->taken->contestants, c);
        const double slower = measure_ratio(t->taken, c, fast).median;
        const double by_least = measure_spread(t->taken, c).least / measure_spread(t->taken, fast).least;
        printf("goal: %s at most %.2f times fast: %s, %.2f (by least %.2f)\n", goals[g].contestant, goals[g].most,
               slower <= goals[g].most ? "reached" : "NOT reached", slower, by_least);
    }
}

void trade_table(const trade *t)
{
    const bool is_all = !strcmp(t->axes, "all");
    const char *const widest = kernel_of(&t->list[t->taken->contestants > 1 && !t->list[0].options.kernel]);
    for (size_t c = 0; c < t->taken->contestants; c++)
        if (is_all || !strcmp(kernel_of(&t->list[c]), widest))
            print_row(t, c);
    for (size_t c = 0; is_all && c < t->taken->contestants; c++)
        print_goals(t, c);
    if (is_all)
        measure_warn_if_disturbed(stdout, t->taken);
    fflush(stdout);
}

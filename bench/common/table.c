/* table.c - the reports of ratios. */
#include "table.h"

#include <stdio.h>

enum { BASELINE = 0 };

static double percent(size_t part, size_t of) { return 100 * (double)part / (double)of; }

/* The baseline's least time over the contestant's: what is left of a ratio where other work disturbs most rounds. */
static double speed_by_least(const result *r, size_t c)
{
    return measure_spread(r->taken, BASELINE).least / measure_spread(r->taken, c).least;
}

static void print_row(const result *r, size_t c)
{
    const size_t count = r->at->work.pairs, fast = entry_fast_of(r->list, r->taken->contestants, c);
    const spread time = measure_spread(r->taken, c), speed = measure_ratio(r->taken, BASELINE, c);
    char slower[16] = "-", undecided[16] = "-";
    if (fast != c)
        snprintf(slower, sizeof slower, "%.2f", measure_ratio(r->taken, c, fast).median);
    if (r->list[c].options.kernel)
        snprintf(undecided, sizeof undecided, "%.4f", percent(r->scores[c].undecided, count));
    printf("%-20s %8.3f %8.3f   %7.2f  [%6.2f, %6.2f] %7.2f %10s %10s", r->list[c].name, time.median, time.least, speed.median,
           speed.lower_quartile, speed.upper_quartile, speed_by_least(r, c), slower, undecided);
    if (r->list[c].promise == PROMISE_NOTHING)
        printf(" %9s %9s\n", "-", "-");
    else
        printf(" %9zu %9zu\n", r->scores[c].overlapping, score_unlike(&r->scores[c]));
}

void table_scene(const result *r)
{
    const size_t count = r->at->work.pairs;
    printf("\nscene %s: %zu triangles (%.3g MB), %s; box [%.8g, %.8g]^3; %zu rounds\n", r->at->name, count, 36e-6 * (double)count,
           r->at->what, (double)r->at->work.jobs[0].box.lo[0], (double)r->at->work.jobs[0].box.hi[0], r->taken->rounds);
    printf("%-20s %17s   %-33s %10s %10s %9s %9s\n", "", "ns per triangle", "times baseline's speed", "times own", "undecided", "",
           "unlike");
    printf("%-20s %8s %8s   %7s  %-16s %7s %10s %10s %9s %9s\n", "contestant", "median", "least", "median", "[quartiles]",
           "by least", "fast's ns", "percent", "overlaps", "EXACT");
    for (size_t c = 0; c < r->taken->contestants; c++)
        print_row(r, c);
    measure_warn_if_disturbed(stdout, r->taken);
    fflush(stdout);
}

static void json_spread(json *to, const char *name, spread s)
{
    json_open_object(to, name);
    json_number(to, "least", 6, s.least);
    json_number(to, "lower_quartile", 6, s.lower_quartile);
    json_number(to, "median", 6, s.median);
    json_number(to, "upper_quartile", 6, s.upper_quartile);
    json_close(to);
}

static void json_contestant(json *to, const result *r, size_t c)
{
    const size_t fast = entry_fast_of(r->list, r->taken->contestants, c);
    json_open_object(to, NULL);
    json_string(to, "name", r->list[c].name);
    json_spread(to, "ns_per_triangle", measure_spread(r->taken, c));
    json_spread(to, "baseline_over_it", measure_ratio(r->taken, BASELINE, c));
    json_number(to, "baseline_over_it_by_least", 6, speed_by_least(r, c));
    if (fast != c)
        json_spread(to, "over_own_fast", measure_ratio(r->taken, c, fast));
    if (r->list[c].promise != PROMISE_NOTHING) {
        json_whole(to, "undecided", r->scores[c].undecided);
        json_whole(to, "overlapping", r->scores[c].overlapping);
        json_whole(to, "not_as_exact", score_unlike(&r->scores[c]));
    }
    json_close(to);
}

void table_json(json *to, const result *r)
{
    json_open_object(to, NULL);
    json_string(to, "scene", r->at->name);
    json_whole(to, "triangles", r->at->work.pairs);
    json_whole(to, "rounds", r->taken->rounds);
    json_open_rows(to, "contestants");
    for (size_t c = 0; c < r->taken->contestants; c++)
        json_contestant(to, r, c);
    json_close(to);
    json_close(to);
    fflush(to->to);
}

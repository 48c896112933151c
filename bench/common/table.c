#include "table.h"

#include <stdio.h>

/* The baseline is always the first in the list (ratios.c sees to it). */
enum { BASELINE = 0 };

static size_t unlike_exact(const score *s) { return s->of_all.missed + s->of_all.untrue; }

static double percent(size_t part, size_t of) { return 100 * (double)part / (double)of; }

void table_begin(const run *r) { header_text(stdout, "", r); }

/* The baseline's least time over the contestant's: what is left of a ratio where other work disturbs most rounds. */
static double speed_by_least(const result *r, size_t c)
{
    return measure_spread(r->taken, BASELINE).least / measure_spread(r->taken, c).least;
}

static void print_row(const result *r, size_t c)
{
    const size_t count = r->at->soup.count, fast = contest_fast_of(r->list, r->taken->contestants, c);
    const spread time = measure_spread(r->taken, c), speed = measure_ratio(r->taken, BASELINE, c);
    char slower[16] = "-", undecided[16] = "-";
    if (fast != c)
        snprintf(slower, sizeof slower, "%.2f", measure_ratio(r->taken, c, fast).median);
    if (r->list[c].kind == CONTESTANT_KERNEL)
        snprintf(undecided, sizeof undecided, "%.4f", percent(r->scores[c].undecided, count));
    printf("%-20s %8.3f %8.3f   %7.2f  [%6.2f, %6.2f] %7.2f %10s %10s", r->list[c].name, time.median, time.least, speed.median,
           speed.lower_quartile, speed.upper_quartile, speed_by_least(r, c), slower, undecided);
    if (r->list[c].kind == CONTESTANT_LOADS)
        printf(" %9s %9s\n", "-", "-");
    else
        printf(" %9zu %9zu\n", r->scores[c].overlapping, unlike_exact(&r->scores[c]));
}

void table_scene(const result *r)
{
    const size_t count = r->at->soup.count;
    printf("\nscene %s: %zu triangles (%.3g MB), %s; box [%.8g, %.8g]^3; %zu rounds\n", r->at->name, count, 36e-6 * (double)count,
           r->at->what, (double)r->at->box.lo[0], (double)r->at->box.hi[0], r->taken->rounds);
    printf("%-20s %17s   %-33s %10s %10s %9s %9s\n", "", "ns per triangle", "times baseline's speed", "times own", "undecided", "",
           "unlike");
    printf("%-20s %8s %8s   %7s  %-16s %7s %10s %10s %9s %9s\n", "contestant", "median", "least", "median", "[quartiles]",
           "by least", "fast's ns", "percent", "overlaps", "EXACT");
    for (size_t c = 0; c < r->taken->contestants; c++)
        print_row(r, c);
    measure_warn_if_disturbed(r->taken);
    fflush(stdout);
}

void json_begin(const run *r)
{
    printf("{");
    header_json(stdout, r);
    printf(",\n \"scenes\": [");
}

static void json_spread(const char *name, spread s)
{
    printf(", \"%s\": {\"least\": %.6g, \"lower_quartile\": %.6g, \"median\": %.6g, \"upper_quartile\": %.6g}", name, s.least,
           s.lower_quartile, s.median, s.upper_quartile);
}

void json_scene(const result *r, bool is_first)
{
    printf("%s\n  {\"scene\": \"%s\", \"triangles\": %zu, \"rounds\": %zu, \"contestants\": [", is_first ? "" : ",", r->at->name,
           r->at->soup.count, r->taken->rounds);
    for (size_t c = 0; c < r->taken->contestants; c++) {
        const size_t fast = contest_fast_of(r->list, r->taken->contestants, c);
        printf("%s\n   {\"name\": \"%s\"", c ? "," : "", r->list[c].name);
        json_spread("ns_per_triangle", measure_spread(r->taken, c));
        json_spread("baseline_over_it", measure_ratio(r->taken, BASELINE, c));
        printf(", \"baseline_over_it_by_least\": %.6g", speed_by_least(r, c));
        if (fast != c)
            json_spread("over_own_fast", measure_ratio(r->taken, c, fast));
        if (r->list[c].kind != CONTESTANT_LOADS)
            printf(", \"undecided\": %zu, \"overlapping\": %zu, \"not_as_exact\": %zu", r->scores[c].undecided,
                   r->scores[c].overlapping, unlike_exact(&r->scores[c]));
        printf("}");
    }
    printf("]}");
    fflush(stdout);
}

void json_end(void) { printf("\n ]}\n"); }

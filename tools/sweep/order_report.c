/* order_report.c - what a sweep measured, and why, as text and as JSON. */
#include "order_report.h"

#include <string.h>

#include "console/accuracy.h"
#include "console/options.h"

/*
 * The contestants of a kernel stand together after those of the paper's test; the first of the next kernel, or NULL after the
 * last.
 */
static const contestant *next_kernel(const sweep *s, const contestant *after)
{
    for (const contestant *e = after ? after + 1 : s->list; e < s->list + s->count; e++)
        if (e->options.kernel && (!after || strcmp(e->options.kernel, after->options.kernel) != 0))
            return e;
    return NULL;
}

static void print_row(FILE *to, const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const contestant *const best = sweep_best(s, kernel, accuracy);
    const contestant *const plain = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    fprintf(to, "%-8s %-12s", kernel ? kernel : "paper", kernel ? accuracy_word(accuracy) : "");
    if (!plain)
        fprintf(to, " %7s", "-");
    for (int o = plain ? 0 : 1; o < SWEEP_ORDERS; o++)
        fprintf(to, " %7.3f", sweep_time(s, sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o])));
    if (!plain)
        fprintf(to, "   -\n");
    else if (sweep_beats(s, best, plain))
        fprintf(to, "   %u, by %.1f %%\n", best->options.axis_order, 100 * (1 - sweep_time(s, best) / sweep_time(s, plain)));
    else
        fprintf(to, "   none\n");
}

void report_best(FILE *to, const sweep *s)
{
    const char *const kernel = tribox_kernel_name(NULL);
    const contestant *const plain = sweep_find(s, kernel, TRIBOX_EXACT, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    fprintf(to, "time         %.3g ns a pair, exact, in the default order; the paper's algorithm: %.3g ns\n", sweep_time(s, plain),
            sweep_time(s, sweep_best(s, NULL, TRIBOX_FAST)));
}

void report_times(FILE *to, const sweep *s)
{
    fprintf(to, "Nanoseconds per pair, least of %zu rounds, by order: 1 box normals, 2 plane, 3 edges\n\n", s->taken.rounds);
    fprintf(to, "%-21s", "kernel   accuracy");
    fprintf(to, " %7s", "default");
    for (int o = 1; o < SWEEP_ORDERS; o++)
        fprintf(to, " %7u", sweep_orders[o]);
    fprintf(to, "   faster than default\n");
    print_row(to, s, NULL, TRIBOX_FAST);
    for (const contestant *k = next_kernel(s, NULL); k; k = next_kernel(s, k))
        for (int a = 0; a < SWEEP_ACCURACIES; a++)
            print_row(to, s, k->options.kernel, sweep_accuracies[a]);
}

static void print_axes_row(FILE *to, const sweep *s, unsigned axes, size_t pairs)
{
    static const char *const names[] = {"", "box", "plane", "box,plane", "edges", "box,edges", "plane,edges", "all"};
    size_t reported = 0, unlike = 0;
    fprintf(to, "%-12s", names[axes]);
    for (const contestant *k = next_kernel(s, NULL); k; k = next_kernel(s, k)) {
        const contestant *const e = sweep_find(s, k->options.kernel, TRIBOX_EXACT, axes, SWEEP_DEFAULT);
        fprintf(to, " %8.3f", sweep_time(s, e));
        reported = sweep_score(s, e)->overlapping;
        unlike = score_unlike(sweep_score(s, e));
    }
    fprintf(to, " %12zu %12zu %9.3f\n", reported, unlike, 100 * (double)unlike / (double)pairs);
}

void report_axes(FILE *to, const sweep *s, const why *w)
{
    fprintf(to, "Axes left out, EXACT: nanoseconds per pair, and pairs that are reported and do not overlap\n\n%-12s", "axes");
    for (const contestant *k = next_kernel(s, NULL); k; k = next_kernel(s, k))
        fprintf(to, " %8s", k->options.kernel);
    fprintf(to, " %12s %12s %9s\n", "reported", "false", "% of all");
    print_axes_row(to, s, TRIBOX_AXES_ALL, w->pairs);
    for (int x = 0; x < SWEEP_AXES; x++)
        print_axes_row(to, s, sweep_axes[x], w->pairs);
}

static double percent(size_t part, size_t of) { return of ? 100 * (double)part / (double)of : 0; }

static void print_axis_names(FILE *to, const char *before)
{
    fprintf(to, "%-21s", before);
    for (int axis = 0; axis < WHY_AXES; axis++)
        fprintf(to, " %5s", why_axis_name(axis));
}

static void print_axis_counts(FILE *to, const char *before, const size_t counts[WHY_AXES], size_t pairs)
{
    fprintf(to, "%-21s", before);
    for (int axis = 0; axis < WHY_AXES; axis++)
        fprintf(to, " %5.1f", percent(counts[axis], pairs));
}

static void print_first(FILE *to, const why *w)
{
    fprintf(to, "Percent of the pairs by the axis that rejects them; ze1: the edge axis of z and edge 1\n\n");
    print_axis_names(to, "");
    fprintf(to, "\n");
    print_axis_counts(to, "separates", w->apart, w->pairs);
    fprintf(to, "\n");
    print_axis_counts(to, "no box normal does", w->unboxed, w->pairs);
    fprintf(to, "\n");
    print_axis_counts(to, "alone", w->only, w->pairs);
    fprintf(to, "\n");
    for (int o = 0; o < WHY_ORDERS; o++) {
        char label[32];
        snprintf(label, sizeof label, "first in order %u", why_orders[o]);
        print_axis_counts(to, label, w->order[o].first, w->pairs);
        fprintf(to, "\n");
    }
    fprintf(to, "%.2f %% of %zu pairs overlap\n", percent(w->overlapping, w->pairs), w->pairs);
}

static void print_left(FILE *to, const why *w)
{
    fprintf(to, "Percent of the packets left after the first, second and third group; bytes loaded per pair\n\n%-8s", "lanes");
    for (int l = 0; l < WHY_WIDTHS; l++)
        fprintf(to, "  %14u %5s", why_lanes[l], "bytes");
    fprintf(to, "\n");
    for (int o = 0; o < WHY_ORDERS; o++) {
        fprintf(to, "%-8u", why_orders[o]);
        for (int l = 0; l < WHY_WIDTHS; l++) {
            const size_t *const left = w->order[o].packets_left[l], all = w->packets[l];
            fprintf(to, "  %4.0f %4.0f %4.0f %5.1f", percent(left[0], all), percent(left[1], all), percent(left[2], all),
                    (double)w->order[o].bytes[l] / (double)w->pairs);
        }
        fprintf(to, "\n");
    }
    const double filled = percent(w->pairs, w->packets[0]);
    if (filled < 99.95)
        fprintf(to, "A soup is walked in whole words of 64: %.1f %% of the lanes hold a pair, the others zeros\n", filled);
}

void report_why(FILE *to, const why *w)
{
    print_first(to, w);
    fprintf(to, "\n");
    print_left(to, w);
}

static void json_contestant(json *to, const sweep *s, size_t c)
{
    const contestant *const one = &s->list[c];
    const char *const kernel = one->options.kernel ? one->options.kernel : one->name;
    json_open_object(to, NULL);
    json_string(to, "kernel", kernel);
    json_whole(to, "lanes", why_lanes[why_width_of(kernel)]);
    json_string(to, "accuracy", accuracy_word(one->options.accuracy));
    json_whole(to, "axes", one->options.axes);
    json_whole(to, "order", one->options.axis_order);
    if (one->options.kernel)
        json_whole(to, "undecided", s->scores[c].undecided);
    json_whole(to, "reported", s->scores[c].overlapping);
    json_whole(to, "unlike_exact", score_unlike(&s->scores[c]));
    json_open_array(to, "ns_per_pair");
    for (size_t r = 0; r < s->taken.rounds; r++)
        json_number(to, NULL, 5, s->taken.ns[c][r]);
    json_close(to);
    json_close(to);
}

void report_json_sweep(json *to, const sweep *s)
{
    json_whole(to, "rounds", s->taken.rounds);
    json_open_rows(to, "entrants");
    for (size_t c = 0; c < s->count; c++)
        json_contestant(to, s, c);
    json_close(to);
}

static void json_order(json *to, const why *w, int o)
{
    json_open_object(to, NULL);
    json_whole(to, "order", why_orders[o]);
    json_wholes(to, "first", w->order[o].first, WHY_AXES);
    json_open_rows(to, "lanes");
    for (int l = 0; l < WHY_WIDTHS; l++) {
        json_open_object(to, NULL);
        json_whole(to, "lanes", why_lanes[l]);
        json_whole(to, "packets", w->packets[l]);
        json_wholes(to, "packets_left", w->order[o].packets_left[l], 3);
        json_whole(to, "bytes", w->order[o].bytes[l]);
        json_close(to);
    }
    json_close(to);
    json_close(to);
}

void report_json_why(json *to, const why *w)
{
    json_whole(to, "pairs", w->pairs);
    json_whole(to, "overlapping", w->overlapping);
    json_open_object(to, "axes");
    json_open_array(to, "names");
    for (int axis = 0; axis < WHY_AXES; axis++)
        json_string(to, NULL, why_axis_name(axis));
    json_close(to);
    json_wholes(to, "separates", w->apart, WHY_AXES);
    json_wholes(to, "no_box_normal_does", w->unboxed, WHY_AXES);
    json_wholes(to, "alone", w->only, WHY_AXES);
    json_close(to);
    json_open_rows(to, "orders");
    for (int o = 0; o < WHY_ORDERS; o++)
        json_order(to, w, o);
    json_close(to);
}

/* The fastest of those that answer exactly as all axes do. */
static const contestant *fastest_right(const sweep *s, const char *kernel, const contestant *best)
{
    for (int x = 0; x < SWEEP_AXES; x++) {
        const contestant *const one = sweep_find(s, kernel, TRIBOX_EXACT, sweep_axes[x], SWEEP_DEFAULT);
        if (!score_unlike(sweep_score(s, one)) && sweep_beats(s, one, best))
            best = one;
    }
    return best;
}

sweep_advice sweep_advise(const sweep *s)
{
    const char *const kernel = tribox_kernel_name(NULL);
    const contestant *const plain = sweep_find(s, kernel, TRIBOX_EXACT, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    const contestant *const best = sweep_best(s, kernel, TRIBOX_EXACT);
    const contestant *const advised = fastest_right(s, kernel, sweep_beats(s, best, plain) ? best : plain);
    return (sweep_advice){.kernel = kernel,
                          .order = advised->options.axis_order,
                          .axes = advised->options.axes,
                          .gain = 1 - sweep_time(s, advised) / sweep_time(s, plain)};
}

void sweep_advice_text(const sweep_advice *advice, char *text, size_t size)
{
    char axes[32] = "";
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++) {
        unsigned bit;
        const char *const word = options_axes_word(i, &bit);
        const size_t length = strlen(axes);
        if (advice->axes & bit)
            snprintf(axes + length, sizeof axes - length, "%s%s", length ? "," : "", word);
    }
    if (advice->axes != TRIBOX_AXES_ALL)
        snprintf(text, size,
                 "Use the axes %s here, in the default order: with kernel %s they report nothing false on these pairs and take "
                 "%.1f %% less time than all axes.",
                 axes, advice->kernel, 100 * advice->gain);
    else if (advice->gain > 0)
        snprintf(text, size, "Use order %u and all axes here: with kernel %s it takes %.1f %% less time than the default.",
                 advice->order, advice->kernel, 100 * advice->gain);
    else
        snprintf(
            text, size,
            "Use the default here, which finds the order as it goes, and all axes: with kernel %s no fixed order, and no choice "
            "of axes that reports nothing false, is faster beyond the spread.",
            advice->kernel);
}

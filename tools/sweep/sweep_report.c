/* sweep_report.c - what a sweep measured, and why, as text, as JSON and as an SVG. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console/accuracy.h"
#include "console/options.h"
#include "sweep.h"

static const char *const axis_names[WHY_AXES] = {"x",   "y",   "z",   "plane", "xe0", "xe1", "xe2",
                                                 "ye0", "ye1", "ye2", "ze0",   "ze1", "ze2"};

static void print_row(const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const contestant *const best = sweep_best(s, kernel, accuracy);
    const contestant *const plain = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    printf("%-8s %-12s", kernel ? kernel : "paper", kernel ? accuracy_word(accuracy) : "");
    if (!plain)
        printf(" %7s", "-");
    for (int o = plain ? 0 : 1; o < SWEEP_ORDERS; o++)
        printf(" %7.3f", sweep_time(s, sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o])));
    if (!plain)
        printf("   -\n");
    else if (sweep_beats(s, best, plain))
        printf("   %u, by %.1f %%\n", best->options.axis_order, 100 * (1 - sweep_time(s, best) / sweep_time(s, plain)));
    else
        printf("   none\n");
}

void report_best(const sweep *s)
{
    const char *const kernel = tribox_kernel_name(NULL);
    const contestant *const plain = sweep_find(s, kernel, TRIBOX_EXACT, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    printf("time         %.3g ns a pair, exact, in the default order; the paper's algorithm: %.3g ns\n", sweep_time(s, plain),
           sweep_time(s, sweep_best(s, NULL, TRIBOX_FAST)));
}

static void print_times(const sweep *s)
{
    printf("Nanoseconds per pair, least of %zu rounds, by order: 1 box normals, 2 plane, 3 edges\n\n", s->taken.rounds);
    printf("%-21s", "kernel   accuracy");
    printf(" %7s", "default");
    for (int o = 1; o < SWEEP_ORDERS; o++)
        printf(" %7u", sweep_orders[o]);
    printf("   faster than default\n");
    print_row(s, NULL, TRIBOX_FAST);
    for (size_t k = 0; tribox_kernel_list(k); k++)
        for (int a = 0; a < SWEEP_ACCURACIES; a++)
            print_row(s, tribox_kernel_list(k), sweep_accuracies[a]);
}

static void print_axes_row(const sweep *s, unsigned axes, size_t pairs)
{
    static const char *const names[] = {"", "box", "plane", "box,plane", "edges", "box,edges", "plane,edges", "all"};
    size_t reported = 0, unlike = 0;
    printf("%-12s", names[axes]);
    for (size_t k = 0; tribox_kernel_list(k); k++) {
        const contestant *const e = sweep_find(s, tribox_kernel_list(k), TRIBOX_EXACT, axes, SWEEP_DEFAULT);
        printf(" %8.3f", sweep_time(s, e));
        reported = sweep_score(s, e)->overlapping;
        unlike = score_unlike(sweep_score(s, e));
    }
    printf(" %12zu %12zu %9.3f\n", reported, unlike, 100 * (double)unlike / (double)pairs);
}

static void print_axes(const sweep *s, const why *w)
{
    printf("Axes left out, EXACT: nanoseconds per pair, and pairs that are reported and do not overlap\n\n%-12s", "axes");
    for (size_t k = 0; tribox_kernel_list(k); k++)
        printf(" %8s", tribox_kernel_list(k));
    printf(" %12s %12s %9s\n", "reported", "false", "% of all");
    print_axes_row(s, TRIBOX_AXES_ALL, w->pairs);
    for (int x = 0; x < SWEEP_AXES; x++)
        print_axes_row(s, sweep_axes[x], w->pairs);
}

static double percent(size_t part, size_t of) { return of ? 100 * (double)part / (double)of : 0; }

static void print_counts(const char *before, const size_t counts[WHY_AXES], size_t pairs)
{
    printf("%-21s", before);
    for (int axis = 0; axis < WHY_AXES; axis++)
        printf(" %5.1f", percent(counts[axis], pairs));
    printf("\n");
}

static void print_first(const why *w)
{
    printf("Percent of the pairs by the axis that rejects them; ze1: the edge axis of z and edge 1\n\n%-21s", "");
    for (int axis = 0; axis < WHY_AXES; axis++)
        printf(" %5s", axis_names[axis]);
    printf("\n");
    print_counts("separates", w->apart, w->pairs);
    print_counts("no box normal does", w->unboxed, w->pairs);
    print_counts("alone", w->only, w->pairs);
    for (int o = 0; o < WHY_ORDERS; o++) {
        char label[32];
        snprintf(label, sizeof label, "first in order %u", why_orders[o]);
        print_counts(label, w->order[o].first, w->pairs);
    }
    printf("%.2f %% of %zu pairs overlap\n", percent(w->overlapping, w->pairs), w->pairs);
}

static void print_left(const why *w)
{
    printf("Percent of the packets left after the first, second and third group; bytes loaded per pair\n\n%-8s", "lanes");
    for (int l = 0; l < WHY_WIDTHS; l++)
        printf("  %14u %5s", why_lanes[l], "bytes");
    printf("\n");
    for (int o = 0; o < WHY_ORDERS; o++) {
        printf("%-8u", why_orders[o]);
        for (int l = 0; l < WHY_WIDTHS; l++) {
            const size_t *const left = w->order[o].packets_left[l], all = w->packets[l];
            printf("  %4.0f %4.0f %4.0f %5.1f", percent(left[0], all), percent(left[1], all), percent(left[2], all),
                   (double)w->order[o].bytes[l] / (double)w->pairs);
        }
        printf("\n");
    }
    const double filled = percent(w->pairs, w->packets[0]);
    if (filled < 99.95)
        printf("A soup is walked in whole words of 64: %.1f %% of the lanes hold a pair, the others zeros\n", filled);
}

void report_tables(const sweep *s, const why *w)
{
    printf("\n");
    print_times(s);
    printf("\n");
    print_axes(s, w);
    printf("\n");
    print_first(w);
    printf("\n");
    print_left(w);
}

static unsigned lanes_of(const char *kernel)
{
    const bool is_one = !kernel || !strcmp(kernel, "scalar");
    return why_lanes[is_one ? 0 : !strcmp(kernel, "avx2") ? 2 : !strcmp(kernel, "avx512") ? 3 : 1];
}

static void json_contestant(json *to, const sweep *s, size_t c)
{
    const contestant *const one = &s->list[c];
    const char *const kernel = one->options.kernel;
    json_open_object(to, NULL);
    json_string(to, "kernel", kernel ? kernel : one->name);
    json_whole(to, "lanes", lanes_of(kernel));
    json_string(to, "accuracy", accuracy_word(one->options.accuracy));
    json_whole(to, "axes", one->options.axes);
    json_whole(to, "order", one->options.axis_order);
    if (kernel)
        json_whole(to, "undecided", s->scores[c].undecided);
    json_whole(to, "reported", s->scores[c].overlapping);
    json_whole(to, "unlike_exact", score_unlike(&s->scores[c]));
    json_open_array(to, "ns_per_pair");
    for (size_t r = 0; r < s->taken.rounds; r++)
        json_number(to, NULL, 5, s->taken.ns[c][r]);
    json_close(to);
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

void report_json(json *to, const sweep *s, const why *w)
{
    json_whole(to, "pairs", w->pairs);
    json_whole(to, "overlapping", w->overlapping);
    json_open_object(to, "axes");
    json_open_array(to, "names");
    for (int axis = 0; axis < WHY_AXES; axis++)
        json_string(to, NULL, axis_names[axis]);
    json_close(to);
    json_wholes(to, "separates", w->apart, WHY_AXES);
    json_wholes(to, "no_box_normal_does", w->unboxed, WHY_AXES);
    json_wholes(to, "alone", w->only, WHY_AXES);
    json_close(to);
    json_open_rows(to, "orders");
    for (int o = 0; o < WHY_ORDERS; o++)
        json_order(to, w, o);
    json_close(to);
    json_whole(to, "rounds", s->taken.rounds);
    json_open_rows(to, "entrants");
    for (size_t c = 0; c < s->count; c++)
        json_contestant(to, s, c);
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

static void write_advice(sweep_advice *to)
{
    char axes[32] = "";
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++) {
        unsigned bit;
        const char *const word = options_axes_word(i, &bit);
        const size_t length = strlen(axes);
        if (to->axes & bit)
            snprintf(axes + length, sizeof axes - length, "%s%s", length ? "," : "", word);
    }
    if (to->axes != TRIBOX_AXES_ALL)
        snprintf(to->text, sizeof to->text,
                 "Use the axes %s here, in the default order: with kernel %s they report nothing false on these pairs and take "
                 "%.1f %% less time than all axes.",
                 axes, to->kernel, 100 * to->gain);
    else if (to->gain > 0)
        snprintf(to->text, sizeof to->text,
                 "Use order %u and all axes here: with kernel %s it takes %.1f %% less time than the default.", to->order,
                 to->kernel, 100 * to->gain);
    else
        snprintf(to->text, sizeof to->text,
                 "Use the default here, which finds the order as it goes, and all axes: with kernel %s no fixed order, and no "
                 "choice of axes that reports nothing false, is faster beyond the spread.",
                 to->kernel);
}

sweep_advice sweep_advise(const sweep *s)
{
    const char *const kernel = tribox_kernel_name(NULL);
    const contestant *const plain = sweep_find(s, kernel, TRIBOX_EXACT, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    const contestant *const best = sweep_best(s, kernel, TRIBOX_EXACT);
    const contestant *const advised = fastest_right(s, kernel, sweep_beats(s, best, plain) ? best : plain);
    sweep_advice advice = {kernel, advised->options.axis_order, advised->options.axes,
                           1 - sweep_time(s, advised) / sweep_time(s, plain), ""};
    write_advice(&advice);
    return advice;
}

/* ---- the chart: an SVG, written line by line --------------------------------------------------------------------------------- */

/* In pixels. */
enum { WIDTH = 1100, LEFT = 110, TOP = 108, PANEL = 150, GAP = 62, BAR = 42, BETWEEN = 26 };

static const char *const colours[SWEEP_ORDERS] = {"#1f78b4", "#1b9e77", "#404040", "#d95f02", "#e6ab02", "#7570b3", "#e7298a"};

static void text_at(FILE *to, double x, double y, const char *style, const char *text)
{
    fprintf(to, "<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, style);
    for (; *text; text++)
        if (strchr("<>&", *text))
            fprintf(to, "&#%d;", *text);
        else
            putc((unsigned char)*text < 0x20 ? ' ' : *text, to);
    fputs("</text>\n", to);
}

static void draw_legend(FILE *to)
{
    for (int o = 0; o < SWEEP_ORDERS; o++) {
        char order[16];
        const int x = 16 + 76 * o;
        snprintf(order, sizeof order, o ? "%u" : "default", sweep_orders[o]);
        fprintf(to, "<rect x=\"%d\" y=\"60\" width=\"14\" height=\"14\" fill=\"%s\"/>\n", x, colours[o]);
        text_at(to, x + 20, 72, "font-size=\"13\"", order);
    }
    text_at(to, 16 + 76 * SWEEP_ORDERS, 72, "font-size=\"12\" fill=\"#606060\"", "order: 1 box normals, 2 plane, 3 edges");
}

/* One order of a kernel at an accuracy, its figure above the bar. */
static void draw_bar(FILE *to, int x, int base, double height, int order, double ns, bool is_least)
{
    char figure[32];
    fprintf(to, "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" fill=\"%s\"/>\n", x + 2, base - height, BAR - 4, height,
            colours[order]);
    snprintf(figure, sizeof figure, "%.*f", ns < 10 ? 2 : ns < 100 ? 1 : 0, ns);
    text_at(to, x + BAR / 2.0, base - height - 4,
            is_least ? "font-size=\"11\" text-anchor=\"middle\" font-weight=\"bold\"" : "font-size=\"11\" text-anchor=\"middle\"",
            figure);
}

/* The bars of a kernel at an accuracy, from x on. most: the time of a bar as high as the panel. */
static void draw_group(FILE *to, const sweep *s, const char *kernel, tribox_accuracy accuracy, int x, int base, double most)
{
    const contestant *const plain = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    const double best = sweep_time(s, sweep_best(s, kernel, accuracy)), least = plain ? fmin(best, sweep_time(s, plain)) : best;
    for (int o = 0; o < SWEEP_ORDERS; o++) {
        const contestant *const one = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o]);
        const double ns = one ? sweep_time(s, one) : 0;
        if (one)
            draw_bar(to, x + o * BAR, base, PANEL * ns / most, o, ns, ns <= least);
    }
    text_at(to, x + SWEEP_ORDERS * BAR / 2.0, base + 17, "font-size=\"12\" text-anchor=\"middle\"",
            kernel ? accuracy_word(accuracy) : "as published");
}

/* 1, 2 or 5 times a power of ten: the distance of three to six marks up to `most`. */
static double step_for(double most)
{
    double step = pow(10, floor(log10(most)));
    if (most / step < 3)
        step /= most / step < 1.5 ? 5 : 2;
    return most / step > 6 ? 2 * step : step;
}

/* The marks of a panel: its scale is its own, so that the fast kernels can be read outside the slow ones. */
static void draw_axis(FILE *to, int base, double most, double top)
{
    const double step = step_for(most);
    for (double at = 0; at <= top; at += step) {
        const double y = base - PANEL * at / top;
        char mark[32];
        snprintf(mark, sizeof mark, "%g", at);
        fprintf(to, "<line x1=\"%d\" y1=\"%.1f\" x2=\"%d\" y2=\"%.1f\" stroke=\"#d8d8d8\"/>\n", LEFT - 6, y, WIDTH - 20, y);
        text_at(to, LEFT - 10, y + 4, "font-size=\"11\" fill=\"#606060\" text-anchor=\"end\"", mark);
    }
}

/* kernel: NULL for the paper's test, which has one accuracy. */
static void draw_panel(FILE *to, const sweep *s, const char *kernel, int top)
{
    const int base = top + PANEL;
    double most = 0;
    for (const contestant *one = s->list; one < s->list + s->count; one++)
        if (sweep_is_of(one, kernel) && one->options.axes == TRIBOX_AXES_ALL)
            most = fmax(most, sweep_time(s, one));
    const double step = step_for(most), highest = step * ceil(most / step);
    draw_axis(to, base, most, highest);
    text_at(to, 16, top - 8, "font-size=\"15\"", kernel ? kernel : "paper");
    for (int a = 0; a < (kernel ? SWEEP_ACCURACIES : 1); a++)
        draw_group(to, s, kernel, sweep_accuracies[a], LEFT + a * (SWEEP_ORDERS * BAR + BETWEEN), base, highest);
    fprintf(to, "<line x1=\"%d\" y1=\"%d\" x2=\"%d\" y2=\"%d\" stroke=\"#404040\"/>\n", LEFT - 6, base, WIDTH - 20, base);
}

void sweep_chart(FILE *to, const sweep *s, const char *title, const char *processor)
{
    char axis[512];
    int count = 0;
    while (tribox_kernel_list((size_t)count))
        count++;
    const int height = TOP + (count + 1) * (PANEL + GAP);
    fprintf(
        to,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\">\n"
        "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
        WIDTH, height, WIDTH, height);
    text_at(to, 16, 26, "font-size=\"16\"", title);
    snprintf(axis, sizeof axis, "nanoseconds per pair, the least in bold, each kernel with a scale of its own; %s", processor);
    text_at(to, 16, 46, "font-size=\"13\" fill=\"#606060\"", axis);
    draw_legend(to);
    for (int k = 0; k <= count; k++)
        draw_panel(to, s, tribox_kernel_list((size_t)k), TOP + k * (PANEL + GAP));
    fputs("</svg>\n", to);
}

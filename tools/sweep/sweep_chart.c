/* sweep_chart.c - the SVG of a sweep, written line by line. */
#include "sweep_chart.h"

#include <math.h>

#include "console/accuracy.h"

/* In pixels. */
enum { WIDTH = 1100, LEFT = 110, TOP = 108, PANEL = 150, GAP = 62, BAR = 42, BETWEEN = 26 };

static const char *const colours[SWEEP_ORDERS] = {"#1f78b4", "#1b9e77", "#404040", "#d95f02", "#e6ab02", "#7570b3", "#e7298a"};

static void text_at(FILE *to, double x, double y, const char *style, const char *text)
{
    fprintf(to, "<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, style);
    for (; *text; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", to);
            break;
        case '>':
            fputs("&gt;", to);
            break;
        case '&':
            fputs("&amp;", to);
            break;
        default:
            putc((unsigned char)*text < 0x20 ? ' ' : *text, to);
        }
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

/* The time of the fastest order of a kernel at an accuracy. */
static double least_of(const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const contestant *const plain = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    const double best = sweep_time(s, sweep_best(s, kernel, accuracy));
    return plain ? fmin(best, sweep_time(s, plain)) : best;
}

/* The bars of a kernel at an accuracy, from x on. most: the time of a bar as high as the panel. */
static void draw_group(FILE *to, const sweep *s, const char *kernel, tribox_accuracy accuracy, int x, int base, double most)
{
    const double least = least_of(s, kernel, accuracy);
    for (int o = 0; o < SWEEP_ORDERS; o++) {
        const contestant *const one = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o]);
        const double ns = one ? sweep_time(s, one) : 0;
        if (one)
            draw_bar(to, x + o * BAR, base, PANEL * ns / most, o, ns, ns <= least);
    }
    text_at(to, x + SWEEP_ORDERS * BAR / 2.0, base + 17, "font-size=\"12\" text-anchor=\"middle\"",
            kernel ? accuracy_word(accuracy) : "as published");
}

/* The slowest order of a kernel at any accuracy. */
static double most_of(const sweep *s, const char *kernel)
{
    double most = 0;
    for (int a = 0; a < SWEEP_ACCURACIES; a++)
        for (int o = 0; o < SWEEP_ORDERS; o++) {
            const contestant *const one = sweep_find(s, kernel, sweep_accuracies[a], TRIBOX_AXES_ALL, sweep_orders[o]);
            if (one && sweep_time(s, one) > most)
                most = sweep_time(s, one);
        }
    return most;
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
    const double most = most_of(s, kernel), step = step_for(most), highest = step * ceil(most / step);
    draw_axis(to, base, most, highest);
    text_at(to, 16, top - 8, "font-size=\"15\"", kernel ? kernel : "paper");
    for (int a = 0; a < (kernel ? SWEEP_ACCURACIES : 1); a++)
        draw_group(to, s, kernel, sweep_accuracies[a], LEFT + a * (SWEEP_ORDERS * BAR + BETWEEN), base, highest);
    fprintf(to, "<line x1=\"%d\" y1=\"%d\" x2=\"%d\" y2=\"%d\" stroke=\"#404040\"/>\n", LEFT - 6, base, WIDTH - 20, base);
}

void sweep_chart(FILE *to, const sweep *s, const char *title)
{
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
    text_at(to, 16, 46, "font-size=\"13\" fill=\"#606060\"",
            "nanoseconds per pair of a triangle and a box, the least in bold; each kernel has a scale of its own");
    draw_legend(to);
    for (int k = 0; k <= count; k++)
        draw_panel(to, s, tribox_kernel_list((size_t)k), TOP + k * (PANEL + GAP));
    fputs("</svg>\n", to);
}

/* report.c - prints the answer about one box: for people, as a list, or as JSON. */
#include "report.h"

#include <stdio.h>

#include "options.h"
#include "output.h"

static double share_percent(const mesh *m, const answer *a)
{
    return 100.0 * (double)a->report.overlapping / (double)m->soup.count;
}

static double ns_per_triangle(const mesh *m, const answer *a) { return 1e9 * a->seconds / (double)m->soup.count; }

static bool is_set(const uint64_t *mask, size_t i) { return mask[i / 64] >> i % 64 & 1; }

static void print_summary(const mesh *m, const request *r, const answer *a)
{
    printf("mesh         %s\n", r->mesh_path);
    printf("box          ");
    output_box(&a->box);
    printf("\ntriangles    %zu", m->soup.count);
    if (m->left_out)
        printf(" (and %zu points or lines, left out)", m->left_out);
    putchar('\n');
    printf("overlapping  %zu (%.2f %%)\n", a->report.overlapping, share_percent(m, a));
    printf("undecided    %zu\n", a->report.undecided);
    printf("test         %s, axes ", options_accuracy_word(r->test.accuracy));
    output_axes(r->test.axes, "", ",");
    printf(", kernel %s\n", tribox_kernel_name(&r->test));
    printf("time         %.3f ms, %.2f ns per triangle (the test alone, best of %d run%s)\n", 1e3 * a->seconds,
           ns_per_triangle(m, a), a->runs, a->runs == 1 ? "" : "s");
}

static void print_line(const mesh *m, const answer *a)
{
    output_box(&a->box);
    printf(": %zu of %zu triangles overlap (%.2f %%), %zu undecided, %.2f ns per triangle\n", a->report.overlapping, m->soup.count,
           share_percent(m, a), a->report.undecided, ns_per_triangle(m, a));
}

static void print_list(const mesh *m, const uint64_t *mask, const char *before, const char *behind)
{
    const char *separator = "";
    for (size_t i = 0; i < m->soup.count; i++)
        if (is_set(mask, i)) {
            printf("%s%zu%s", separator, i, behind);
            separator = before;
        }
}

static void print_json(const mesh *m, const request *r, const answer *a, const uint64_t *mask)
{
    printf("{\"mesh\": ");
    output_json_string(r->mesh_path);
    if (a->line)
        printf(", \"line\": %zu", a->line);
    printf(", \"box\": ");
    output_json_box(&a->box);
    printf(", \"triangles\": %zu, \"not_finite\": %zu, \"overlapping\": %zu, \"share_percent\": %.6g, \"undecided\": %zu",
           m->soup.count, m->not_finite, a->report.overlapping, share_percent(m, a), a->report.undecided);
    printf(", \"accuracy\": \"%s\", \"axes\": [", options_accuracy_word(r->test.accuracy));
    output_axes(r->test.axes, "\"", ", ");
    printf("], \"kernel\": \"%s\", \"runs\": %d, \"seconds\": %.6g, \"ns_per_triangle\": %.6g", tribox_kernel_name(&r->test),
           a->runs, a->seconds, ns_per_triangle(m, a));
    if (r->wants_list) {
        printf(", \"indices\": [");
        print_list(m, mask, ", ", "");
        putchar(']');
    }
    puts("}");
}

int report_print(const mesh *m, const request *r, const answer *a, const uint64_t *mask)
{
    if (r->wants_json)
        print_json(m, r, a, mask);
    else if (r->wants_list)
        print_list(m, mask, "", "\n");
    else if (r->boxes_path)
        print_line(m, a);
    else
        print_summary(m, r, a);
    return output_flush();
}

/* report.c - prints answers; the list comes before the counts, as it may be printed while the mesh is read. */
#include "report.h"

#include <inttypes.h>
#include <stdio.h>

#include "console/message.h"
#include "console/options.h"
#include "console/output.h"

static double percent(const answer *a, uint64_t count) { return 100.0 * (double)count / (double)a->triangles; }

static double ns_per_triangle(const answer *a) { return 1e9 * a->seconds / (double)a->triangles; }

/* As the command line takes it. */
static void print_box(const request *r, const answer *a)
{
    if (!r->has_oriented) {
        output_box(&a->box);
        return;
    }
    const float *const parts[5] = {r->oriented.center, r->oriented.half, r->oriented.axis[0], r->oriented.axis[1],
                                   r->oriented.axis[2]};
    for (int i = 0; i < 5; i++) {
        fputs(i ? "," : "oriented ", stdout);
        output_point(parts[i], ",");
    }
}

static void print_share(const char *name, const answer *a, uint64_t count)
{
    printf("%-12s %" PRIu64 " (%.2f %%)\n", name, count, percent(a, count));
}

static void print_summary(const request *r, const answer *a)
{
    printf("mesh         %s\n", r->mesh_path);
    printf("box          ");
    print_box(r, a);
    printf("\ntriangles    %" PRIu64, a->triangles);
    if (a->left_out)
        printf(" (and %" PRIu64 " points or lines, left out)", a->left_out);
    putchar('\n');
    print_share("overlapping", a, a->overlapping);
    if (r->wants_inside) {
        print_share("inside", a, a->inside);
        print_share("straddling", a, a->overlapping - a->inside);
        print_share("missing", a, a->triangles - a->overlapping);
    }
    printf("undecided    %" PRIu64 "\n", a->undecided);
    printf("test         %s, axes ", options_accuracy_word(r->test.accuracy));
    output_axes(r->test.axes, "", ",");
    printf(", kernel %s\n", tribox_kernel_name(&r->test));
    printf("time         %.3f ms, %.2f ns per triangle (the test alone, ", 1e3 * a->seconds, ns_per_triangle(a));
    if (a->total_seconds > 0)
        printf("in blocks; with reading the mesh %.3f ms)\n", 1e3 * a->total_seconds);
    else
        printf("best of %d run%s)\n", a->runs, a->runs == 1 ? "" : "s");
}

static void print_line(const request *r, const answer *a)
{
    output_box(&a->box);
    printf(": %" PRIu64 " of %" PRIu64 " triangles overlap (%.2f %%), ", a->overlapping, a->triangles, percent(a, a->overlapping));
    if (r->wants_inside)
        printf("%" PRIu64 " inside, ", a->inside);
    printf("%" PRIu64 " undecided, %.2f ns per triangle\n", a->undecided, ns_per_triangle(a));
}

static void print_json_oriented(const tribox_oriented_box *box)
{
    fputs("{\"center\": [", stdout);
    output_point(box->center, ", ");
    fputs("], \"half\": [", stdout);
    output_point(box->half, ", ");
    for (int k = 0; k < 3; k++) {
        fputs(k ? "], [" : "], \"axes\": [[", stdout);
        output_point(box->axis[k], ", ");
    }
    fputs("]]}", stdout);
}

/* What is known before the first triangle is tested. */
static void print_json_head(const request *r, const answer *a)
{
    printf("{\"mesh\": ");
    output_json_string(r->mesh_path);
    if (a->line)
        printf(", \"line\": %zu", a->line);
    printf(r->has_oriented ? ", \"oriented\": " : ", \"box\": ");
    if (r->has_oriented)
        print_json_oriented(&r->oriented);
    else
        output_json_box(&a->box);
}

static void print_json_tail(const request *r, const answer *a)
{
    printf(", \"triangles\": %" PRIu64 ", \"not_finite\": %" PRIu64 ", \"overlapping\": %" PRIu64 ", \"share_percent\": %.6g",
           a->triangles, a->not_finite, a->overlapping, percent(a, a->overlapping));
    if (r->wants_inside)
        printf(", \"inside\": %" PRIu64 ", \"straddling\": %" PRIu64 ", \"missing\": %" PRIu64, a->inside,
               a->overlapping - a->inside, a->triangles - a->overlapping);
    printf(", \"undecided\": %" PRIu64 ", \"accuracy\": \"%s\", \"axes\": [", a->undecided,
           options_accuracy_word(r->test.accuracy));
    output_axes(r->test.axes, "\"", ", ");
    printf("], \"kernel\": \"%s\", \"runs\": %d, \"seconds\": %.6g, \"ns_per_triangle\": %.6g", tribox_kernel_name(&r->test),
           a->runs, a->seconds, ns_per_triangle(a));
    if (a->total_seconds > 0)
        printf(", \"total_seconds\": %.6g", a->total_seconds);
    puts("}");
}

int report_list(const request *r, answer *a, uint64_t first, const uint64_t *mask, size_t count)
{
    uint32_t set[TRIANGLE_BLOCK];
    if (!first && r->wants_json) {
        print_json_head(r, a);
        printf(", \"indices\": [");
    }
    for (size_t start = 0; start < count; start += TRIANGLE_BLOCK) {
        const size_t part = count - start < TRIANGLE_BLOCK ? count - start : TRIANGLE_BLOCK;
        const size_t listed = tribox_mask_indices(mask + start / 64, part, set);
        for (size_t i = 0; i < listed; i++)
            printf("%s%" PRIu64 "%s", r->wants_json && a->listed++ ? ", " : "", first + start + set[i], r->wants_json ? "" : "\n");
    }
    /* Lines are of use one by one, part of an object is not. */
    return r->wants_json && !ferror(stdout) ? EXIT_CODE_OK : output_flush();
}

int report_end(const request *r, const answer *a)
{
    if (r->wants_json) {
        if (r->wants_list)
            putchar(']');
        else
            print_json_head(r, a);
        print_json_tail(r, a);
    } else if (r->boxes_path) {
        print_line(r, a);
    } else if (!r->wants_list) {
        print_summary(r, a);
    }
    return output_flush();
}

/* report.c - prints answers; the list comes before the counts, as it may be printed while the mesh is read. */
#include "overlap.h"

#include <inttypes.h>
#include <stdio.h>

#include "console/written_number.h"
#include "console/message.h"
#include "console/numbers.h"
#include "console/output.h"

static const char *const index_words[] = {
    [INDEX_NONE] = "none", [INDEX_IN_FILE_ORDER] = "in file order", [INDEX_ORDERED] = "ordered"};

static const char *const sides[CROP_SIDES] = {"part", "rest"};

static double percent(const answer *a, uint64_t count) { return 100.0 * (double)count / (double)a->triangles; }

static double ns_per_triangle(const answer *a) { return 1e9 * a->seconds / (double)a->triangles; }

/* Whether the numbers of the box are printed as floats. */
static bool is_float_box(const answer *a) { return !a->is_double && box_is_float(&a->box); }

static const char *positions_word(const answer *a) { return a->is_double ? "float64" : "float32"; }

static void print_oriented(const request *r)
{
    const tribox_oriented_box *const box = &r->oriented;
    const double *const parts[5] = {box->center, box->half, box->axis[0], box->axis[1], box->axis[2]};
    fputs("oriented ", stdout);
    for (int i = 0; i < 5; i++) {
        fputs(i ? "," : "", stdout);
        output_point(parts[i], numbers_are_floats(parts[i], 3), ",");
    }
}

/* As the command line takes it. */
static void print_box(const request *r, const answer *a)
{
    if (r->has_oriented)
        print_oriented(r);
    else
        output_box(&a->box, is_float_box(a));
}

static void print_share(const char *name, const answer *a, uint64_t count)
{
    printf("%-12s %" PRIu64 " (%.2f %%)\n", name, count, percent(a, count));
}

static void print_crop(const request *r, const answer *a)
{
    for (int s = 0; s < CROP_SIDES; s++) {
        const crop_counts *const c = &a->crop[s];
        if (!r->crop_paths[s])
            continue;
        printf("%-12s %s (%" PRIu64 " face%s", sides[s], r->crop_paths[s], c->faces, c->faces == 1 ? "" : "s");
        if (c->has_vertices)
            printf(", %" PRIu64 " vert%s", c->vertices, c->vertices == 1 ? "ex" : "ices");
        puts(")");
    }
}

static void print_summary(const request *r, const answer *a)
{
    char text[DURATION_MAX];
    printf("mesh         %s\n", r->mesh_path);
    printf("box          ");
    print_box(r, a);
    putchar('\n');
    if (r->shift.is_wanted)
        output_shift(r->shift.by);
    printf("triangles    %" PRIu64, a->triangles);
    if (a->left_out)
        printf(" (and %" PRIu64 " points or lines, left out)", a->left_out);
    printf("\npositions    %s\n", positions_word(a));
    print_share("overlapping", a, a->overlapping);
    if (r->wants_inside) {
        print_share("inside", a, a->inside);
        print_share("straddling", a, a->overlapping - a->inside);
        print_share("missing", a, a->triangles - a->overlapping);
    }
    output_test(&r->test);
    printf("\ntime         %s, %.2f ns per triangle (the test alone, ", duration_text(a->seconds, text), ns_per_triangle(a));
    if (a->total_seconds > 0)
        printf("in blocks; with reading the mesh %s)\n", duration_text(a->total_seconds, text));
    else
        printf("best of %d run%s)\n", a->runs, a->runs == 1 ? "" : "s");
    print_crop(r, a);
}

static void json_crop(json *j, const request *r, const answer *a)
{
    for (int s = 0; s < CROP_SIDES; s++) {
        if (!r->crop_paths[s])
            continue;
        json_open_object(j, sides[s]);
        json_string(j, "output", r->crop_paths[s]);
        json_whole(j, "faces", a->crop[s].faces);
        if (a->crop[s].has_vertices)
            json_whole(j, "vertices", a->crop[s].vertices);
        json_close(j);
    }
}

static void print_line(const request *r, const answer *a)
{
    output_box(&a->box, is_float_box(a));
    printf(": %" PRIu64 " of %" PRIu64 " triangles overlap (%.2f %%), ", a->overlapping, a->triangles, percent(a, a->overlapping));
    if (r->wants_inside)
        printf("%" PRIu64 " inside, ", a->inside);
    if (a->stage == INDEX_NONE)
        printf("%.2f ns per triangle\n", ns_per_triangle(a));
    else
        printf("%.2f us by an index\n", 1e6 * a->seconds);
}

static void print_json_box(json *j, const answer *a)
{
    const bool is_float = is_float_box(a);
    json_open_object(j, "box");
    json_doubles(j, "lo", a->box.lo, 3, is_float);
    json_doubles(j, "hi", a->box.hi, 3, is_float);
    json_close(j);
}

static void print_json_oriented(json *j, const request *r)
{
    const tribox_oriented_box *const box = &r->oriented;
    json_open_object(j, "oriented");
    json_doubles(j, "center", box->center, 3, numbers_are_floats(box->center, 3));
    json_doubles(j, "half", box->half, 3, numbers_are_floats(box->half, 3));
    json_open_array(j, "axes");
    for (int k = 0; k < 3; k++)
        json_doubles(j, NULL, box->axis[k], 3, numbers_are_floats(box->axis[k], 3));
    json_close(j);
    json_close(j);
}

/* What is known before the first triangle is tested. */
static void print_json_head(const request *r, answer *a)
{
    a->json = json_to(stdout);
    json_open_object(&a->json, NULL);
    json_string(&a->json, "mesh", r->mesh_path);
    if (a->line)
        json_whole(&a->json, "line", a->line);
    if (r->has_oriented)
        print_json_oriented(&a->json, r);
    else
        print_json_box(&a->json, a);
    if (r->wants_list)
        json_open_array(&a->json, "indices");
}

static void print_json_tail(const request *r, answer *a)
{
    json *const j = &a->json;
    if (r->wants_list)
        json_close(j);
    json_whole(j, "triangles", a->triangles);
    json_string(j, "positions", positions_word(a));
    if (r->shift.is_wanted)
        json_doubles(j, "shift", r->shift.by, 3, false);
    json_whole(j, "not_finite", a->not_finite);
    json_whole(j, "rounded", a->rounded);
    json_number(j, "moved", 6, a->moved);
    json_whole(j, "overlapping", a->overlapping);
    json_number(j, "share_percent", 6, percent(a, a->overlapping));
    if (r->wants_inside) {
        json_whole(j, "inside", a->inside);
        json_whole(j, "straddling", a->overlapping - a->inside);
        json_whole(j, "missing", a->triangles - a->overlapping);
    }
    json_whole(j, "undecided", a->undecided);
    output_json_test(j, &r->test);
    if (r->boxes_path)
        json_string(j, "index", index_words[a->stage]);
    json_whole(j, "runs", (uint64_t)a->runs);
    json_number(j, "seconds", 6, a->seconds);
    json_number(j, "ns_per_triangle", 6, ns_per_triangle(a));
    if (a->total_seconds > 0)
        json_number(j, "total_seconds", 6, a->total_seconds);
    json_crop(j, r, a);
    json_close(j);
}

static void list_triangle(const request *r, answer *a, uint64_t index)
{
    if (r->wants_json)
        json_whole(&a->json, NULL, index);
    else
        printf("%" PRIu64 "\n", index);
}

static void list_triangles(const request *r, answer *a, uint64_t first, const uint64_t *mask, size_t count)
{
    uint32_t set[TRIANGLE_BLOCK];
    const size_t listed = tribox_mask_indices(mask, count, set);
    for (size_t i = 0; i < listed; i++)
        list_triangle(r, a, first + set[i]);
}

/* Each line is of use by itself; a part of an object is not. */
static int end_list(const request *r) { return r->wants_json && !ferror(stdout) ? EXIT_CODE_OK : output_flush(); }

int report_list(const request *r, answer *a, uint64_t first, const uint64_t *mask, size_t count)
{
    if (!first && r->wants_json)
        print_json_head(r, a);
    for (size_t start = 0; start < count; start += TRIANGLE_BLOCK)
        list_triangles(r, a, first + start, mask + start / 64, count - start < TRIANGLE_BLOCK ? count - start : TRIANGLE_BLOCK);
    return end_list(r);
}

int report_words(const request *r, answer *a, const found_words *words)
{
    if (r->wants_json)
        print_json_head(r, a);
    for (size_t k = 0; k < words->count; k++)
        list_triangles(r, a, 64 * (uint64_t)words->number[k], &words->bits[k], 64);
    return end_list(r);
}

int report_end(const request *r, answer *a)
{
    if (!r->has_report)
        return EXIT_CODE_OK;
    if (r->wants_json) {
        if (!r->wants_list)
            print_json_head(r, a);
        print_json_tail(r, a);
    } else if (r->boxes_path) {
        print_line(r, a);
    } else if (!r->wants_list) {
        print_summary(r, a);
    }
    return output_flush();
}

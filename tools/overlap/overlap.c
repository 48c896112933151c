/* overlap.c - tests triangles against the box of a request; reads a mesh and answers about one box, or about box after box. */
#define _POSIX_C_SOURCE 200809L
#include "overlap.h"

#include <stdlib.h>

#include "console/clock.h"
#include "console/message.h"
#include "console/progress.h"
#include "console/system.h"
#include "read/mesh_file.h"
#include "write/voxels.h"

int masks_make(size_t count, bool wants_inside, masks *bits)
{
    const size_t words = tribox_mask_words(count);
    bits->overlap = malloc((words * (wants_inside ? 2 : 1) + 1) * sizeof *bits->overlap);
    bits->inside = bits->overlap && wants_inside ? bits->overlap + words : NULL;
    return bits->overlap ? EXIT_CODE_OK : message_failure("out of memory for the answers of %zu triangles", count);
}

void masks_free(masks *bits)
{
    free(bits->overlap);
    *bits = (masks){.overlap = NULL};
}

int overlap_crop(const request *r, const masks *bits, crop_files *files, answer *a)
{
    const crop_choice choice = {r->wants_inside ? bits->inside : bits->overlap, a->triangles, r->wants_inside};
    return crop_write(files, &choice, a->crop);
}

asked_triangles triangles_of_mesh(const mesh *m)
{
    return (asked_triangles){.count = m->triangles, .is_double = m->is_double, .soup = m->soup, .doubles = m->doubles};
}

static tribox_status ask(const request *r, const asked_triangles *t, const masks *bits, const tribox_box *box,
                         tribox_report *report)
{
    if (r->has_oriented)
        return t->is_double ? tribox_mesh_overlap_oriented(&t->doubles, &r->oriented, &r->test, bits->overlap, report)
                            : tribox_overlap_oriented(&t->soup, &r->oriented, &r->test, bits->overlap, report);
    if (r->wants_inside)
        return t->is_double ? tribox_mesh_classify(&t->doubles, box, &r->test, bits->overlap, bits->inside, report)
                            : tribox_classify(&t->soup, box, &r->test, bits->overlap, bits->inside, report);
    return t->is_double ? tribox_mesh_overlap(&t->doubles, box, &r->test, bits->overlap, report)
                        : tribox_overlap(&t->soup, box, &r->test, bits->overlap, report);
}

int overlap_ask(const request *r, const asked_triangles *t, const masks *bits, answer *a)
{
    tribox_report report;
    const double start = clock_seconds();
    const tribox_status status = ask(r, t, bits, &a->box, &report);
    a->seconds += clock_seconds() - start;
    if (status)
        return message_status(status);
    a->overlapping += report.overlapping;
    a->undecided += report.undecided;
    a->inside += bits->inside ? voxels_count(bits->inside, tribox_mask_words(t->count)) : 0;
    return EXIT_CODE_OK;
}

/* Tests a mesh up to `runs` times, fewer when it is slow; the best time counts. */
static int run_test(const mesh *m, const request *r, const masks *bits, int runs, answer *a)
{
    const asked_triangles all = triangles_of_mesh(m);
    const double slow = 0.1;
    const answer none = *a;
    double total = 0;
    for (int run = 1; run <= runs && total < slow; run++) {
        answer once = none;
        const int code = overlap_ask(r, &all, bits, &once);
        if (code)
            return code;
        total += once.seconds;
        if (run > 1 && a->seconds < once.seconds)
            once.seconds = a->seconds;
        *a = once;
        a->runs = run;
    }
    return EXIT_CODE_OK;
}

static void tell_mesh(const mesh *m, answer *a)
{
    a->triangles = m->triangles;
    a->is_double = m->is_double;
    a->left_out = m->left_out;
    a->not_finite = m->seen.not_finite;
    a->rounded = m->rounded;
    a->moved = m->moved;
}

/* The mesh gives way to the file, which is read again. */
static int answer_box(mesh *m, const request *r, crop_files *files)
{
    masks bits;
    const size_t triangles = m->triangles;
    answer a = {.box = box_for_mesh(&r->box, m->is_double)};
    tell_mesh(m, &a);
    int code = masks_make(m->triangles, r->wants_inside, &bits);
    if (!code)
        code = run_test(m, r, &bits, 5, &a);
    mesh_free(m);
    if (!code && files)
        code = overlap_crop(r, &bits, files, &a);
    if (!code && r->wants_list)
        code = report_list(r, &a, 0, bits.overlap, triangles);
    masks_free(&bits);
    return code ? code : report_end(r, &a);
}

static int answer_next(box_after_box *b, answer *a)
{
    tell_mesh(b->m, a);
    int code = box_after_box_ask(b, a);
    if (!code && b->r->wants_list)
        code = box_after_box_list(b, a);
    return code ? code : report_end(b->r, a);
}

static int answer_lines(box_after_box *b, box_file *boxes)
{
    bool end = false;
    int code = EXIT_CODE_OK;
    size_t answered = 0;
    for (;; answered++) {
        answer a = {.runs = 1};
        written_box box;
        code = box_file_next(boxes, &box, &end);
        if (code || end)
            break;
        a.box = box_for_mesh(&box, b->m->is_double);
        a.line = boxes->line;
        code = answer_next(b, &a);
        if (code)
            break;
    }
    if (!code && !answered)
        message_say("note: %s: there is no box in it", boxes->name);
    return code;
}

static int answer_boxes(mesh *m, const request *r)
{
    box_file boxes;
    box_after_box b;
    int code = box_file_open(&boxes, r->boxes_path);
    if (code)
        return code;
    code = box_after_box_start(r, m, &b);
    if (!code)
        code = answer_lines(&b, &boxes);
    box_after_box_end(&b);
    box_file_close(&boxes);
    return code;
}

static int answer_mesh(const request *r, crop_files *files)
{
    mesh m;
    request own = *r; /* its shift is found from the mesh */
    const mesh_request from = {.path = r->mesh_path, .format = r->format, .threads = r->threads};
    int code = mesh_read_shifted(&from, &own.shift, &m);
    if (code)
        return code;
    mesh_warn(triangle_file_name(r->mesh_path), &m);
    code = r->boxes_path ? answer_boxes(&m, &own) : answer_box(&m, &own, files);
    mesh_free(&m);
    return code;
}

/* A single box takes one pass over the triangles, for which a file of triangles need not be held in memory. */
static int answer_any(const request *r, crop_files *files)
{
    triangle_file file = {.stream = NULL};
    const int code = r->boxes_path || r->shift.is_wanted ? EXIT_CODE_OK : triangle_file_open(r->mesh_path, r->format, &file);
    if (!code && file.stream)
        return overlap_stream(r, &file, files);
    triangle_file_close(&file);
    return code ? code : answer_mesh(r, files);
}

int overlap_work(const request *r)
{
    crop_files files;
    if (r->wants_list && terminal_is(stdout)) /* a bar would only be in the way */
        progress_silence();
    if (!r->crop_paths[CROP_PART] && !r->crop_paths[CROP_REST])
        return answer_any(r, NULL);
    int code = crop_files_open(r->mesh_path, r->format, r->crop_paths, &files);
    if (!code)
        code = answer_any(r, &files);
    crop_files_drop(&files);
    return code;
}

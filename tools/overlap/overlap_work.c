/* overlap_work.c - reads a mesh and answers about one box, or about box after box. */
#define _POSIX_C_SOURCE 200809L
#include "box_after_box.h"
#include "console/message.h"
#include "console/terminal.h"
#include "read/reading.h"
#include "report.h"

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
    a->not_finite = m->not_finite;
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
    int code = mesh_read_shifted(r->mesh_path, r->format, &own.shift, r->threads, &m);
    if (code)
        return code;
    mesh_warn(r->mesh_path, &m);
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
    reading_show(!(r->wants_list && terminal_is(stdout)));
    if (!r->crop_paths[CROP_PART] && !r->crop_paths[CROP_REST])
        return answer_any(r, NULL);
    int code = crop_files_open(r->mesh_path, r->format, r->crop_paths, &files);
    if (!code)
        code = answer_any(r, &files);
    crop_files_drop(&files);
    return code;
}

/* overlap.c - tests a soup against the box of a request. */
#define _POSIX_C_SOURCE 200809L
#include "overlap.h"

#include <stdlib.h>

#include "console/clock.h"
#include "console/message.h"

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

static tribox_status ask_doubles(const request *r, const tribox_mesh *doubles, const masks *bits, const tribox_box *box,
                                 tribox_report *report)
{
    if (r->wants_inside)
        return tribox_mesh_classify(doubles, box, &r->test, bits->overlap, bits->inside, report);
    return tribox_mesh_overlap(doubles, box, &r->test, bits->overlap, report);
}

static tribox_status ask(const request *r, const asked_triangles *t, const masks *bits, const tribox_box *box,
                         tribox_report *report)
{
    if (r->has_oriented && t->is_double)
        return tribox_mesh_overlap_oriented(&t->doubles, &r->oriented, &r->test, bits->overlap, report);
    if (r->has_oriented)
        return tribox_overlap_oriented(&t->soup, &r->oriented, &r->test, bits->overlap, report);
    if (t->is_double)
        return ask_doubles(r, &t->doubles, bits, box, report);
    if (r->wants_inside)
        return tribox_classify(&t->soup, box, &r->test, bits->overlap, bits->inside, report);
    return tribox_overlap(&t->soup, box, &r->test, bits->overlap, report);
}

/* In parts, since the library counts up to 2^32 bits at once. */
static uint64_t count_bits(const uint64_t *mask, size_t count)
{
    const size_t part = (size_t)1 << 30;
    uint64_t set = 0;
    for (size_t first = 0; first < count; first += part)
        set += tribox_mask_indices(mask + first / 64, count - first < part ? count - first : part, NULL);
    return set;
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
    a->inside += bits->inside ? count_bits(bits->inside, t->count) : 0;
    return EXIT_CODE_OK;
}

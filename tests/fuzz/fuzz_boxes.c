/* fuzz_boxes.c - tribox_overlap_boxes: a triangle and boxes. */
#include <string.h>

#include "answers.h"
#include "tight_memory.h"
#include "target.h"

typedef struct fuzz_case {
    float triangle[3][3];
    tribox_boxes boxes;
} fuzz_case;

static tribox_status ask(const void *about, const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    const fuzz_case *const q = about;
    return tribox_overlap_boxes((const float *)q->triangle, &q->boxes, options, mask, report);
}

static tribox_boxes asked_boxes(const asked *a, size_t shift)
{
    tribox_boxes boxes = {.count = a->count};
    for (int k = 0; k < 6; k++) {
        float *const stream = tight_memory(a->count * sizeof *stream, shift * sizeof *stream);
        for (size_t i = 0; i < a->count; i++) {
            const tribox_box *const box = &a->pair[i % a->drawn].box;
            stream[i] = k < 3 ? (float)box->lo[k] : (float)box->hi[k - 3];
        }
        (k < 3 ? boxes.lo : boxes.hi)[k % 3] = stream;
    }
    return boxes;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    asked a = {.call = "tribox_overlap_boxes", .how = input_options(&in)};
    const size_t shift = input_below(&in, 4);
    a.count = input_count(&in);
    fuzz_case q;
    input_triangle(&in, q.triangle);
    do {
        pair_f32 *const pair = &a.pair[a.drawn++];
        memcpy(pair->u, q.triangle, sizeof pair->u);
        pair->box = input_box(&in);
    } while (!input_is_over(&in) && a.drawn < PAIRS_DRAWN && a.drawn < a.count);
    a.is_lattice = in.is_lattice;
    q.boxes = asked_boxes(&a, shift);
    answers_check(&a, ask, &q);
    tight_memory_free_all();
    return 0;
}

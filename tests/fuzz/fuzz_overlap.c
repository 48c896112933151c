/* fuzz_overlap.c - tribox_overlap: a soup and a box. */
#include "answers.h"
#include "tight_memory.h"
#include "target.h"

typedef struct fuzz_case {
    tribox_soup soup;
    tribox_box box;
} fuzz_case;

static tribox_status ask(const void *about, const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    const fuzz_case *const q = about;
    return tribox_overlap(&q->soup, &q->box, options, mask, report);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    asked a = {.call = "tribox_overlap", .how = input_options(&in)};
    const size_t shift = input_below(&in, 4);
    a.count = input_count(&in);
    fuzz_case q = {.box = input_box(&in)};
    a.wrong = box_is_finite(&q.box) ? 0 : 1u << TRIBOX_BAD_BOX;
    do {
        pair_f32 *const pair = &a.pair[a.drawn++];
        pair->box = q.box;
        input_triangle(&in, pair->u);
    } while (!input_is_over(&in) && a.drawn < PAIRS_DRAWN && a.drawn < a.count);
    a.is_lattice = in.is_lattice;
    q.soup = asked_soup(&a, shift);
    answers_check(&a, ask, &q);
    tight_memory_free_all();
    return 0;
}

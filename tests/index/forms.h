/* forms.h - every form of a question to an index, compared with what the calls without an index answer. */
#ifndef TRIBOX_TESTS_FORMS_H
#define TRIBOX_TESTS_FORMS_H

#include <stdbool.h>

#include "common/random_draws.h"
#include "common/window_bits.h"
#include "stored.h"
#include "tribox.h"

/* Where the forms write, each between pages that cannot be touched. */
typedef struct form_fences {
    guarded mask, number, bits, inside, list, start, report, found;
} form_fences;

/* For so many triangles at most, and so many boxes at once; `stored` too. Returns 0, as a set-up does. */
extern form_fences fences;
int index_fixture_make(size_t triangles, size_t boxes);

/*
 * Asks all forms about a box: mask, count, words, inside, list, any. EXACT has to be the scalar kernel's tribox_overlap bit for
 * bit, CONSERVATIVE that of the same kernel; FAST may have more, in words that lie wholly inside. Nothing is written outside what
 * is found. `name` is of the soup, for the message.
 */
void check_forms(const tribox_box *box, const tribox_options *options, const char *name);

/* The same about an oriented box, whose mask EXACT alone has to have; CONSERVATIVE misses nothing, and FAST is not known. */
void check_turned(const tribox_oriented_box *box, const tribox_options *options, const char *name);

/*
 * The same of an index that is no longer the one that was built: nothing is outside what there is, and all forms say the same,
 * which may be wrong.
 */
void check_damaged(const tribox_region *region, const tribox_options *options, const char *name);

/* Asks the lists of many boxes at once: each has to be tribox_index_list's, and none where a bound is NaN or infinite. */
void check_lists(const tribox_boxes *boxes, const tribox_options *options, const char *name);

/* Options drawn from all that may be asked: of a kernel that runs here, with the axes of the box. */
tribox_options any_index_options(random_source *r);

#endif

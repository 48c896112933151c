/* answers.h - one question asked of every kernel that runs here at every accuracy, and all that is promised of the answers. */
#ifndef TRIBOX_TESTS_FUZZ_ANSWERS_H
#define TRIBOX_TESTS_FUZZ_ANSWERS_H

#include "input.h"
#include "common/oracle.h"

/* Different pairs are few, since the oracle is slow; a soup repeats them as often as it likes. */
enum { PAIRS_DRAWN = 16 };

/* The kernels that run here, the scalar one first; NULL after the last. */
const char *const *runnable_kernels(void);

/* Options, and as bits of 1 << status what is wrong with them. The kernel stays open where nothing is wrong with it. */
typedef struct drawn_options {
    tribox_options options;
    unsigned wrong;
} drawn_options;

drawn_options input_options(input *in);

/* C has no conversion from float[3][3] to const float[3][3]. */
typedef const float (*const_triangle)[3];
static inline const_triangle triangle_of(const pair_f32 *pair) { return pair->u; }

/* What is asked: pair i is pair[i % drawn]. */
typedef struct asked {
    const char *call; /* its name */
    drawn_options how;
    pair_f32 pair[PAIRS_DRAWN];
    unsigned drawn;
    size_t count;
    unsigned wrong;  /* with the input; as bits of 1 << status */
    bool is_lattice; /* FAST is exact */
} asked;

/* Calls the library about the very pairs. */
typedef tribox_status asking(const void *about, const tribox_options *options, uint64_t *mask, tribox_report *report);

/* Asks, and compares EXACT with the oracle. */
void answers_check(const asked *a, asking *ask, const void *about);

/* The triangles of the pairs as nine streams of exact size, which lie `shift` floats off an aligned place. */
tribox_soup asked_soup(const asked *a, size_t shift);

/* Whether a soup's triangle i has finite numbers alone. */
bool triangle_is_finite(const float u[3][3]);
bool box_is_finite(const tribox_box *box);
bool box_is_empty(const tribox_box *box);

static inline bool mask_bit(const uint64_t *mask, size_t i) { return mask[i / 64] >> i % 64 & 1; }

/* The set bits; those past `count` are claimed to be clear. */
size_t mask_population(const char *call, const uint64_t *mask, size_t count);

/* Claims that a call that found `wrong` returned one of these statuses, or OK if there is none. Returns whether it did its work. */
bool status_fits(const char *call, unsigned wrong, tribox_status status);

#endif

/*
 * words_lanes.h - the words of a vocabulary, applied in all lanes by words_lanes.c and judged lane by lane in test_words.c.
 *
 * With LANES_OF_DOUBLE the vocabulary is the one of double, and has other words in a place or two.
 */
#ifndef TRIBOX_TESTS_WORDS_LANES_H
#define TRIBOX_TESTS_WORDS_LANES_H

#include <stdint.h>

enum { LANES_MAX = 16 };

#if defined(LANES_OF_DOUBLE)
typedef double lane_number;
typedef uint64_t lane_bits;
#else
typedef float lane_number;
typedef uint32_t lane_bits;
#endif

/* Words that give a number. */
typedef enum number_word {
    V_SPLAT, /* of lane 0 */
    V_ADD,
    V_SUB,
    V_MUL,
    V_DIV,
    V_FMA,
    V_FMS,
    V_MIN,
    V_MAX,
    V_ABS,
    V_FLIP,   /* by the sign of b */
    V_WRITE,  /* a, written and read */
    V_SELECT, /* a where b > c, else b */
    V_DROP,   /* NaN where b > c, else a */
    NUMBER_WORDS
} number_word;

/* Words that give a mask, or a number of which only the sign counts: seen through m_bits. */
typedef enum mask_word {
    V_GT, /* a > b */
#if !defined(LANES_OF_DOUBLE)
    M_SIGNS,   /* the sign of a */
    V_EITHER,  /* the sign of a or b */
    V_IS_ZERO, /* a is zero */
#endif
    M_ALL,    /* always */
    M_NONE,   /* never */
    M_NOT,    /* not a > b */
    M_OR,     /* a > b or b > c */
    M_AND,    /* a > b and b > c */
    M_ANDNOT, /* a > b and not b > c */
    MASK_WORDS
} mask_word;

#if !defined(LANES_OF_DOUBLE)
/* Words that give integers. */
typedef enum int_word {
    I_SPLAT, /* of lane 0 */
    I_WRITE, /* a, written and read */
    I_ADD,
    I_SUB,
    I_MUL,
    I_AND,
    I_OR,
    I_ANDNOT,
    I_SHL, /* by b */
    I_SHR, /* by b */
    I_SHL_OVER,
    I_RUN,
    I_COUNT, /* of a */
    I_KEEP,  /* a where b has bits */
    INT_WORDS
} int_word;
#endif

extern const unsigned lanes_count, lanes_fused;

/* Each word over lanes_count numbers of a, b and c. The result `out` has as many. */
void lanes_load(const float *from, lane_number *out);
void lanes_number(number_word word, const lane_number *a, const lane_number *b, const lane_number *c, lane_number *out);
void lanes_cut(const lane_number *a, int32_t *out); /* fractions cut off */
#if !defined(LANES_OF_DOUBLE)
void lanes_load_few(const float *from, unsigned count, lane_number *out, lane_number *first); /* filled with its first; or not */
void lanes_permute(const float *a, const float *b, const int32_t *from, lane_number *out);
void lanes_transpose(const void *const *from, lane_number out[4][LANES_MAX]);
void lanes_near(const void *from, const double *lo, lane_number *out);
void lanes_near_transpose(const void *const *from, const double *lo, lane_number out[4][LANES_MAX]);
void lanes_nearest(const float *a, float *out);
void lanes_int(int_word word, const int32_t *a, const int32_t *b, int32_t *out);
uint64_t lanes_with_bits(const int32_t *a);
void lanes_pack(const float *a, const int32_t *chosen, float *out); /* those where `chosen` has bits */
unsigned lanes_count_with_bits(const int32_t *a);
void lanes_pack_int(const int32_t *a, const int32_t *chosen, int32_t *out);
#endif
uint64_t lanes_mask(mask_word word, const lane_number *a, const lane_number *b, const lane_number *c);

#endif

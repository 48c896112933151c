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

/*
 * WORD(name, kind, what is asked of all lanes, the definition of one lane): words that give a number. `first` is lane 0 of a; MOVED
 * is a word that keeps the payload of a NaN, which one that has MADE it does not promise.
 */
#define NUMBER_WORDS(WORD) \
    WORD(v_splat, MOVED, v_splat(first), first) \
    WORD(v_add, MADE, v_add(a, b), a + b) \
    WORD(v_sub, MADE, v_sub(a, b), a - b) \
    WORD(v_mul, MADE, v_mul(a, b), (a * b)) \
    WORD(v_div, MADE, v_div(a, b), a / b) \
    WORD(v_fma, MADE, v_fma(a, b, c), multiply_add(a, b, c)) \
    WORD(v_fms, MADE, v_fms(a, b, c), multiply_add(a, b, -c)) \
    WORD(v_min, MOVED, v_min(a, b), a < b ? a : b) \
    WORD(v_max, MOVED, v_max(a, b), a > b ? a : b) \
    WORD(v_abs, MOVED, v_abs(a), number_of_bits(bits_of(a) & ~SIGN_BIT)) \
    WORD(v_flip, MADE, v_flip(a, b), number_of_bits(bits_of(a) ^ (bits_of(b) & SIGN_BIT))) \
    WORD(v_write, MOVED, copied(a), a) \
    WORD(v_select, MOVED, v_select(v_gt(b, c), a, b), b > c ? a : b) \
    WORD(v_drop, MADE, v_drop(v_gt(b, c), a), b > c ? NAN : a)

/* Those that give a mask, or a number of which only the sign counts: seen through m_bits. */
#define MASK_WORDS(WORD) \
    FLOAT_MASK_WORDS(WORD) \
    WORD(v_gt, , v_gt(a, b), a > b) \
    WORD(m_all, , m_all(), true) \
    WORD(m_none, , m_none(), false) \
    WORD(m_not, , m_not(v_gt(a, b)), !(a > b)) \
    WORD(m_or, , m_or(v_gt(a, b), v_gt(b, c)), a > b || b > c) \
    WORD(m_and, , m_and(v_gt(a, b), v_gt(b, c)), a > b && b > c) \
    WORD(m_andnot, , m_andnot(v_gt(a, b), v_gt(b, c)), a > b && !(b > c))
#if defined(LANES_OF_DOUBLE)
#define FLOAT_MASK_WORDS(WORD)
#else
#define FLOAT_MASK_WORDS(WORD) \
    WORD(m_signs, , m_signs(a), bits_of(a) >= SIGN_BIT) \
    WORD(v_either, , m_signs(v_either(a, b)), (bits_of(a) | bits_of(b)) >= SIGN_BIT) \
    WORD(v_is_zero, , v_is_zero(a), a == 0)

/* Those that give integers: bits alone, of which those shifted out on either side are gone. */
#define INT_WORDS(WORD) \
    WORD(i_splat, ANY, i_splat(first), first) \
    WORD(i_write, ANY, copied_int(a), a) \
    WORD(i_add, ANY, i_add(a, b), a + b) \
    WORD(i_sub, ANY, i_sub(a, b), a - b) \
    WORD(i_mul, ANY, i_mul(a, b), (uint32_t)((uint64_t)a * b)) \
    WORD(i_and, ANY, i_and(a, b), a &b) \
    WORD(i_or, ANY, i_or(a, b), a | b) \
    WORD(i_andnot, ANY, i_andnot(a, b), a & ~b) \
    WORD(i_shl, PLACES, i_shl(a, b), b < 32 ? a << b : 0) \
    WORD(i_shr, PLACES, i_shr(a, b), b < 32 ? a >> b : 0) \
    WORD(i_shl_over, PLACES, i_shl_over(a, b), (uint32_t)((uint64_t)a << b >> 32)) \
    WORD(i_run, PLACES, i_run(a, b), bits_between(a, b)) \
    WORD(i_count, ANY, i_count(a), count_bits(a)) \
    WORD(i_keep, ANY, i_keep(m_has_bits(b), a), b ? a : 0)
#endif

/* Each word's number is WORD_ and its name. */
#define WORD_NUMBER(name, kind, of_lanes, of_one) WORD_##name,
typedef enum number_word { NUMBER_WORDS(WORD_NUMBER) NUMBER_WORD_COUNT } number_word;
typedef enum mask_word { MASK_WORDS(WORD_NUMBER) MASK_WORD_COUNT } mask_word;
#if !defined(LANES_OF_DOUBLE)
typedef enum int_word { INT_WORDS(WORD_NUMBER) INT_WORD_COUNT } int_word;
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

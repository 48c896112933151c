/* words_lanes.c - every word of one vocabulary, compiled as its kernel is. */
#include VOCABULARY

#include <string.h>

#include "words_lanes.h"

_Static_assert(V_LANES <= LANES_MAX, "LANES_MAX in words_lanes.h has to grow with the widest vocabulary");

const unsigned lanes_count = V_LANES, lanes_fused = V_FUSED;

/* Not v_load, which is a word under test, and takes float alone. */
static vnum lanes_of(const lane_number *from)
{
    vnum number;
    memcpy(&number, from, sizeof number);
    return number;
}

static void put(vnum number, lane_number *out) { memcpy(out, &number, sizeof number); }

void lanes_load(const float *from, lane_number *out) { put(v_load(from), out); }

static vnum copied(vnum a)
{
    lane_number memory[LANES_MAX + 1]; /* at any alignment */
    v_write(memory + 1, a);
#if defined(LANES_OF_DOUBLE)
    return v_read(memory + 1);
#else
    return v_load(memory + 1);
#endif
}

/* A case for each word of a table. */
#define WORD_OF_LANES(name, kind, of_lanes, of_one) \
    case WORD_##name: \
        return of_lanes;

static vnum number_of(number_word word, lane_number first, vnum a, vnum b, vnum c)
{
    switch (word) {
        NUMBER_WORDS(WORD_OF_LANES)
    default:
        return a;
    }
}

void lanes_number(number_word word, const lane_number *a, const lane_number *b, const lane_number *c, lane_number *out)
{
    put(number_of(word, *a, lanes_of(a), lanes_of(b), lanes_of(c)), out);
}

#if defined(LANES_OF_DOUBLE)
void lanes_cut(const lane_number *a, int32_t *out) { v_write_int(out, lanes_of(a)); }
#else
void lanes_cut(const lane_number *a, int32_t *out) { i_write(out, i_cut(lanes_of(a))); }

void lanes_load_few(const float *from, unsigned count, lane_number *out, lane_number *first)
{
    put(count < V_LANES ? v_load_few(from, count) : v_load(from), out);
    put(v_load_up_to(from, count), first);
}

void lanes_permute(const float *a, const float *b, const int32_t *from, lane_number *out)
{
    put(v_permute(lanes_of(a), lanes_of(b), from), out);
}

void lanes_transpose(const void *const *from, lane_number out[4][LANES_MAX])
{
    vnum to[4];
    v_transpose4(from, to);
    for (int k = 0; k < 4; k++)
        put(to[k], out[k]);
}

void lanes_near(const void *from, const double *lo, lane_number *out) { put(v_local(from, lo), out); }

void lanes_near_transpose(const void *const *from, const double *lo, lane_number out[4][LANES_MAX])
{
    vnum to[4];
    v_local_transpose4(from, lo, to);
    for (int k = 0; k < 4; k++)
        put(to[k], out[k]);
}

void lanes_nearest(const float *a, float *out) { put(v_nearest(lanes_of(a)), out); }

/* Not i_load, which is a word under test. */
static vint ints_of(const int32_t *from)
{
    vint number;
    memcpy(&number, from, sizeof number);
    return number;
}

static vint copied_int(vint a)
{
    int32_t memory[LANES_MAX + 1]; /* at any alignment */
    i_write(memory + 1, a);
    return i_load(memory + 1);
}

static vint int_of(int_word word, int32_t first, vint a, vint b)
{
    switch (word) {
        INT_WORDS(WORD_OF_LANES)
    default:
        return a;
    }
}

void lanes_int(int_word word, const int32_t *a, const int32_t *b, int32_t *out)
{
    const vint number = int_of(word, *a, ints_of(a), ints_of(b));
    memcpy(out, &number, sizeof number);
}

uint64_t lanes_with_bits(const int32_t *a) { return m_bits(m_has_bits(ints_of(a))); }

unsigned lanes_count_with_bits(const int32_t *a) { return m_count(m_has_bits(ints_of(a))); }

void lanes_pack(const float *a, const int32_t *chosen, float *out) { v_pack(out, m_has_bits(ints_of(chosen)), lanes_of(a)); }

void lanes_pack_int(const int32_t *a, const int32_t *chosen, int32_t *out) { i_pack(out, m_has_bits(ints_of(chosen)), ints_of(a)); }
#endif

static vmask mask_of(mask_word word, vnum a, vnum b, vnum c)
{
    switch (word) {
        MASK_WORDS(WORD_OF_LANES)
    default:
        return m_none();
    }
}

uint64_t lanes_mask(mask_word word, const lane_number *a, const lane_number *b, const lane_number *c)
{
    return m_bits(mask_of(word, lanes_of(a), lanes_of(b), lanes_of(c)));
}

#if TRIBOX_POP_TARGET
#pragma clang attribute pop
#endif

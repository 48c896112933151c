/* kept_numbers.h - numbers of vertices, some of which are kept: those get numbers from 0, in the same order. */
#ifndef KEPT_NUMBERS_H
#define KEPT_NUMBERS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct kept_numbers {
    uint64_t *bits;
    uint32_t *before; /* each word of bits: how many are kept */
    uint64_t count, kept;
} kept_numbers;

/* Of `count` numbers none is kept yet. path: for the message. Returns an exit_code; kept_numbers_free may follow in any case. */
int kept_numbers_make(const char *path, uint64_t count, kept_numbers *k);
void kept_numbers_free(kept_numbers *k);

static inline void kept_numbers_add(kept_numbers *k, uint64_t number) { k->bits[number / 64] |= UINT64_C(1) << number % 64; }

static inline bool kept_numbers_has(const kept_numbers *k, uint64_t number) { return k->bits[number / 64] >> number % 64 & 1; }

/* To be called between the last that is added and the first that is asked for. */
void kept_numbers_count(kept_numbers *k);

/* The new number of one that is kept. */
uint64_t kept_numbers_new(const kept_numbers *k, uint64_t number);

#endif

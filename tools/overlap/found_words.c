/* found_words.c - numbers are put into ascending order by setting bits, so nothing is compared. */
#include "found_words.h"

#include <stdlib.h>
#include <string.h>

#include "tribox.h"

bool found_words_make(found_words *w, size_t triangles)
{
    const size_t words = tribox_mask_words(triangles), touched = tribox_mask_words(words);
    uint64_t *const memory = calloc(2 * words + touched + words / 2 + 1, sizeof *memory);
    *w = (found_words){.room = words, .bits = memory};
    if (!memory)
        return false;
    w->mask = memory + words;
    w->touched = w->mask + words;
    w->number = (uint32_t *)(w->touched + touched);
    return true;
}

static void scatter(found_words *w, size_t word, const uint32_t *order)
{
    uint32_t bit[64];
    const size_t set = tribox_mask_indices(&w->bits[word], 64, bit);
    for (size_t i = 0; i < set; i++) {
        const uint32_t to = order[64 * (size_t)w->number[word] + bit[i]];
        w->mask[to / 64] |= UINT64_C(1) << to % 64;
        w->touched[to / 4096] |= UINT64_C(1) << to / 64 % 64;
    }
}

void found_words_renumber(found_words *w, const uint32_t *order)
{
    for (size_t k = 0; k < w->count; k++)
        scatter(w, k, order);
    w->count = tribox_mask_indices(w->touched, w->room, w->number);
    memset(w->touched, 0, tribox_mask_words(w->room) * sizeof *w->touched);
    for (size_t k = 0; k < w->count; k++) {
        w->bits[k] = w->mask[w->number[k]];
        w->mask[w->number[k]] = 0;
    }
}

void found_words_free(found_words *w)
{
    free(w->bits);
    *w = (found_words){.bits = NULL};
}

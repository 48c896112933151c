/* own_words.c - takes words by thread, and puts strips of them together. */
#include "own_words.h"

#include "console/pages.h"
#include "tribox.h"

enum { STRIP = 4096 };

uint64_t *own_words_of(own_words *w, unsigned thread)
{
    if (thread && !w->own[thread])
        w->own[thread] = pages_take(w->count * sizeof *w->all);
    return thread ? w->own[thread] : w->all;
}

size_t own_words_strips(const own_words *w) { return (w->count + STRIP - 1) / STRIP; }

size_t own_words_join(const own_words *w, size_t strip)
{
    const size_t from = strip * STRIP, left = w->count - from, count = left < STRIP ? left : STRIP;
    uint64_t *const to = w->all + from;
    const size_t before = tribox_mask_indices(to, 64 * count, NULL);
    for (unsigned t = 1; t < THREADS_MAX; t++)
        for (size_t i = 0; w->own[t] && i < count; i++)
            to[i] |= w->own[t][from + i];
    return tribox_mask_indices(to, 64 * count, NULL) - before;
}

void own_words_free(own_words *w)
{
    for (unsigned t = 1; t < THREADS_MAX; t++)
        pages_free(w->own[t], w->count * sizeof *w->all);
}

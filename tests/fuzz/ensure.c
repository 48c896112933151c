#include "ensure.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const tribox_options *about;

void ensure_about(const tribox_options *options) { about = options; }

void ensure(bool holds, const char *format, ...)
{
    if (holds)
        return;
    va_list values;
    va_start(values, format);
    fputs("broken: ", stderr);
    vfprintf(stderr, format, values);
    if (about)
        fprintf(stderr, "; accuracy %d, axes %u, order %u, kernel %s", (int)about->accuracy, about->axes, about->axis_order,
                about->kernel ? about->kernel : "by itself");
    fputc('\n', stderr);
    va_end(values);
    abort();
}

void ensure_status(unsigned wrong, tribox_status status)
{
    ensure(wrong ? status && wrong >> status & 1 : status == TRIBOX_OK, "status %d, expected are the bits of %#x", (int)status,
           wrong);
}

enum { BLOCKS_MAX = 1 << 12 };

static void *blocks[BLOCKS_MAX];
static int count;

void *tight_memory(size_t bytes, size_t shift)
{
    ensure(count < BLOCKS_MAX, "this program makes more than %d blocks", BLOCKS_MAX);
    unsigned char *const block = malloc(shift + bytes);
    ensure(block || !(shift + bytes), "no memory for %zu bytes", shift + bytes);
    blocks[count++] = block;
    if (bytes)
        memset(block + shift, POISON, bytes);
    return block ? block + shift : NULL;
}

uint64_t *tight_mask(size_t bits) { return tight_memory(tribox_mask_words(bits) * sizeof(uint64_t), 0); }

uint64_t *clear_mask(size_t bits)
{
    uint64_t *const mask = tight_mask(bits);
    if (bits)
        memset(mask, 0, tribox_mask_words(bits) * sizeof *mask);
    return mask;
}

void ensure_poisoned(const void *block, size_t bytes)
{
    for (const unsigned char *byte = block, *end = byte + bytes; byte < end; byte++)
        ensure(*byte == POISON, "a call writes although it refuses");
}

void tight_memory_free_all(void)
{
    about = NULL;
    while (count)
        free(blocks[--count]);
}

#include "tight_memory.h"

#include <stdlib.h>
#include <string.h>

#include "ensure.h"
#include "tribox.h"

enum { BLOCKS_MAX = 256 };

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

int is_poisoned(const void *block, size_t bytes)
{
    const unsigned char *const byte = block;
    for (size_t k = 0; k < bytes; k++)
        if (byte[k] != POISON)
            return 0;
    return 1;
}

void tight_memory_free_all(void)
{
    while (count)
        free(blocks[--count]);
}

#include "room.h"

#include <stdlib.h>
#include <string.h>

#include "claim.h"
#include "tribox.h"

enum { ROOMS_MAX = 256 };

static void *rooms[ROOMS_MAX];
static int count;

void *room_make(size_t bytes, size_t shift)
{
    claim(count < ROOMS_MAX, "this program makes more than %d rooms", ROOMS_MAX);
    unsigned char *const room = malloc(shift + bytes);
    claim(room || !(shift + bytes), "no memory for %zu bytes", shift + bytes);
    rooms[count++] = room;
    if (bytes)
        memset(room + shift, ROOM_POISON, bytes);
    return room ? room + shift : NULL;
}

uint64_t *room_mask(size_t bits) { return room_make(tribox_mask_words(bits) * sizeof(uint64_t), 0); }

int room_is_poisoned(const void *room, size_t bytes)
{
    const unsigned char *const byte = room;
    for (size_t k = 0; k < bytes; k++)
        if (byte[k] != ROOM_POISON)
            return 0;
    return 1;
}

void room_free_all(void)
{
    while (count)
        free(rooms[--count]);
}

/* room.h - memory of exactly the size that a call is promised: a sanitizer then sees the first byte read or written beyond it. */
#ifndef TRIBOX_TESTS_FUZZ_ROOM_H
#define TRIBOX_TESTS_FUZZ_ROOM_H

#include <stddef.h>
#include <stdint.h>

/* `shift` bytes behind an aligned place. What it holds is all POISON. */
void *room_make(size_t bytes, size_t shift);

/* The words of a mask for so many bits. */
uint64_t *room_mask(size_t bits);

/* Whether nothing was written. */
int room_is_poisoned(const void *room, size_t bytes);

/* Gives all rooms back. */
void room_free_all(void);

enum { ROOM_POISON = 0xa5 };

#endif

/* tight_memory.h - memory of exactly the size that a call is promised, so that a sanitizer sees the first byte beyond it. */
#ifndef TRIBOX_TESTS_FUZZ_TIGHT_MEMORY_H
#define TRIBOX_TESTS_FUZZ_TIGHT_MEMORY_H

#include <stddef.h>
#include <stdint.h>

/* `bytes` bytes, all POISON, `shift` bytes after an aligned place. */
void *tight_memory(size_t bytes, size_t shift);

/* The words of a mask of `bits` bits. */
uint64_t *tight_mask(size_t bits);

/* Whether nothing was written. */
int is_poisoned(const void *block, size_t bytes);

/* Gives all rooms back. */
void tight_memory_free_all(void);

enum { POISON = 0xa5 };

#endif

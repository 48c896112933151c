/* memory.h - how much memory is available, and lists that grow. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bytes that this process can still take without swapping; UINT64_MAX where neither the system nor a limit says. */
uint64_t memory_available(void);

/* Reads a size, "200000", "64K", "512M", "1G" or "2T". False where it is none, or 0. */
bool memory_read(const char *text, uint64_t *bytes);

/* Writes bytes for people to read, "12.5 GiB". Returns text. */
const char *memory_text(uint64_t bytes, char text[16]);

/*
 * A list with room for `needed` things of `size` bytes, of which it had room for *room: itself, or a larger one in its place. NULL
 * without memory; the list stays then.
 */
void *memory_grow(void *list, size_t needed, size_t *room, size_t size);

/* The same of a list in rooms of pages.h, for lists that grow large: to be freed there, *room times size bytes. */
void *memory_grow_pages(void *list, size_t needed, size_t *room, size_t size);

#endif

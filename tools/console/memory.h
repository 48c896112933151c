/* memory.h - how much memory is available. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stdbool.h>
#include <stdint.h>

/* Bytes that this process can still take without swapping; UINT64_MAX where neither the system nor a limit says. */
uint64_t memory_available(void);

/* Reads a size, "200000", "64K", "512M", "1G" or "2T". False where it is none, or 0. */
bool memory_read(const char *text, uint64_t *bytes);

/* Writes bytes for people to read, "12.5 GiB". Returns text. */
const char *memory_text(uint64_t bytes, char text[16]);

#endif

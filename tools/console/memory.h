/* memory.h - how much memory is available. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stdint.h>

/* Bytes that this process can still take without swapping; UINT64_MAX where neither the system nor a limit says. */
uint64_t memory_available(void);

/* Writes bytes for people to read, "12.5 GiB". Returns text. */
const char *memory_text(uint64_t bytes, char text[16]);

#endif

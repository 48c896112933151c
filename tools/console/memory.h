/* memory.h - how much memory there is to be had. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stdint.h>

/* Bytes that this process may still take without swapping, as the system and its limits tell; UINT64_MAX where they tell nothing. */
uint64_t memory_available(void);

/* Writes bytes for people, as "12.5 GiB", into text[16], and returns it. */
const char *memory_text(uint64_t bytes, char text[16]);

#endif

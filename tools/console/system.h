/* system.h - what the program asks of the system: words and streams, processors, memory; and what it makes of memory. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/*
 * Before anything else: from now on streams carry bytes as they are, text is UTF-8. Returns the words of the command line as
 * such.
 */
char **terminal_begin(int *count, char **words);

/* Leaves the console as it was. Called by itself when the program ends or is interrupted, but not when it is terminated. */
void terminal_end(void);

/* Whether a person looks on. */
bool terminal_is(FILE *stream);

enum { THREADS_MAX = 256 };

/* The processors that are online, from 1 to THREADS_MAX. */
unsigned processors_here(void);

/* Their model as the system names it, on Linux with its numbers and ", virtual" where they are; "unknown" where it does not. */
void processors_name(char *name, size_t size);

/* Bytes that this process can still take without swapping; UINT64_MAX where neither the system nor a limit says. */
uint64_t memory_available(void);

/* Reads a size, "200000", "64K", "512M", "1g" or "2TB". False where it is none, or 0. */
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

/*
 * Zeros, from a multiple of 64 bytes on; NULL where there is no memory. A page is taken when it is first touched, by that thread.
 */
void *pages_take(size_t bytes);

/* bytes: as they were taken. room: NULL for none. */
void pages_free(void *room, size_t bytes);

#ifdef _WIN32
/* Windows names everything in UTF-16. Memory to be freed, or NULL; half a pair becomes a replacement character. */
wchar_t *wide_of_utf8(const char *text);
char *utf8_of_wide(const wchar_t *text);
#endif

#endif

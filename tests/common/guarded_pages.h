/* guarded_pages.h - addresses whose pages may be touched, only read, or neither. */
#ifndef TRIBOX_TESTS_GUARDED_PAGES_H
#define TRIBOX_TESTS_GUARDED_PAGES_H

#include <stdbool.h>
#include <stddef.h>

typedef enum page_access { PAGES_HIDDEN, PAGES_READ_ONLY, PAGES_OPEN } page_access;

size_t page_size(void);

/* Addresses of hidden pages, which take no memory before they are opened. NULL where there are not so many. */
void *pages_reserve(size_t bytes);
void pages_release(void *pages, size_t bytes);

/* Whole pages of them. What was never opened is not to be hidden again. False if the system refuses. */
bool pages_allow(void *from, size_t bytes, page_access access);

/* From now on a fault, an illegal instruction and a floating-point trap go to `tell`, with their name, and end the program. */
void pages_catch_faults(void (*tell)(const char *fault));

/* Writes to standard error, also while a fault is caught. */
void pages_tell(const char *text);

#endif

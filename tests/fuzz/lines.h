/* lines.h - stands in for tools/console/message.c: lines are formatted as there, counted, and not printed; and files to be read. */
#ifndef TRIBOX_TESTS_FUZZ_LINES_H
#define TRIBOX_TESTS_FUZZ_LINES_H

#include <stddef.h>

void lines_forget(void);

/* Claims that a code other than 0 came with at least one line, and a failure with no more than one. */
void lines_fit(const char *call, int code);

/* A folder of this program, which goes with it, and a file that is written there. Returns its path. */
const char *lines_folder(void);
const char *lines_file(const char *name, const void *bytes, size_t size);

#endif

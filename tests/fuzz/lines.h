/* lines.h - stands in for tools/console/message.c: lines are formatted as there, counted, and not printed. */
#ifndef TRIBOX_TESTS_FUZZ_LINES_H
#define TRIBOX_TESTS_FUZZ_LINES_H

void lines_forget(void);

/* Claims that a code other than 0 came with at least one line, and a failure with no more than one. */
void lines_fit(const char *call, int code);

#endif

/* reading.h - the bar of a file that is read for more than a moment; tests and benchmarks show none. */
#ifndef READING_H
#define READING_H

#include <stdbool.h>

/* From now on where standard error is a terminal; or not, as at first. */
void reading_show(bool is_wanted);

/* One file after another. Any thread tells what share is done, 0 to 1: cheap, but not for every triangle. */
void reading_begin(void);
void reading_tell(double done);
void reading_end(void);

#endif

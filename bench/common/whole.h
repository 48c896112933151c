/* whole.h - whole numbers of a benchmark's command line. */
#ifndef BENCH_WHOLE_H
#define BENCH_WHOLE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a number from least to most, which the whole text has to be. Returns an exit_code. option: its name, for the message. */
int whole_read(const char *text, const char *option, uint64_t least, uint64_t most, uint64_t *number);

#ifdef __cplusplus
}
#endif

#endif

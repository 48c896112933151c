/* command_line.h - what the programs of this folder share in reading their command lines. */
#ifndef BENCH_ARGUMENTS_H
#define BENCH_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Says on stderr what is wrong with which word and what would be right. Returns the exit status of a wrong command line, 2. */
int argument_fail(const char *program, const char *what, const char *which, const char *help);

/** Reads a whole number, decimal, 0x or 0 in front; false if it is none or lies outside [least, most]. */
bool argument_number(const char *text, uint64_t least, uint64_t most, uint64_t *number);

/** The index of the scene of that name; false, with the list of scenes on stderr, if there is none. */
bool argument_scene(const char *program, const char *name, size_t *index);

#ifdef __cplusplus
}
#endif

#endif

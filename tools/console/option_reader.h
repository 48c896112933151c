/* option_reader.h - reads a command line by a table of options: "--json", "--js", "-j", "--box V", "--box=V", "-bV". */
#ifndef OPTION_READER_H
#define OPTION_READER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Tables have at most 64 options and end with a NULL name. --help and -h are in none of them. */
typedef struct option_entry {
    const char *name; /* "json", without the dashes */
    char letter;      /* 'j' for -j; 0 for none */
    size_t takes;     /* false or true: whether it has a value, for option_taker; or one of what follows */
} option_entry;

/* A member of the request that the option sets, a bool; or that its value goes to: a const char *, or a uint32_t of threads. */
enum { OPTION_IS_FLAG, OPTION_IS_NAME, OPTION_IS_THREADS = 3, OPTION_KINDS };
#define OPTION_SETS(request, member) (OPTION_KINDS * (offsetof(request, member) + 1))
#define OPTION_NAMES(request, member) (OPTION_SETS(request, member) + OPTION_IS_NAME)
#define OPTION_COUNTS_THREADS(request, member) (OPTION_SETS(request, member) + OPTION_IS_THREADS)

enum { OPTION_OPERAND = -1 };

/*
 * Takes option `which` of the table with its value, if it has one, or OPTION_OPERAND with the operand, into a request.
 * Returns an exit_code.
 */
typedef int option_taker(void *request, int which, const char *value);

typedef struct options_found {
    uint64_t seen;               /* bit i: option i of the table was given */
    bool wants_help;             /* --help or -h was met, which ends the reading */
    const char *const *operands; /* `count` of them, in the place of the words, which are gone */
    size_t count;
} options_found;

/*
 * Takes everything after words[0]. Options and operands come in any order, each option at most once; "--" ends the options.
 * Stops at the first word that is wrong. Returns an exit_code, EXIT_CODE_USAGE after a line on standard error.
 */
int options_read(int count, char **words, const option_entry *table, option_taker *take, void *request, options_found *found);

static inline bool options_has(const options_found *found, int which) { return found->seen >> which & 1; }

#endif

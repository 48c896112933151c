/* options.h - the walk over the arguments of a command, and the words that select a way of testing. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdbool.h>

#include "tribox.h"

/* An option as it is written, "--box". A table of them ends with a NULL name; no more than 32. --help is in none. */
typedef struct option {
    const char *name;
    bool takes_value;
} option;

/* What a walk meets besides the options of its table, which it reports by their index. */
enum { ARGUMENT_END = -1, ARGUMENT_OPERAND = -2, ARGUMENT_WRONG = -3, ARGUMENT_HELP = -4 };

typedef struct arguments {
    int count; /* arguments still to come */
    char **next;
    const option *options;
    unsigned seen; /* bit i: options[i] was given */
    bool only_operands;
    bool wants_help; /* "--help" or "-h" was met */
} arguments;

/*
 * The next argument: the index of an option ("--box VALUE", "--box=VALUE"), ARGUMENT_OPERAND, ARGUMENT_END, ARGUMENT_HELP, or
 * ARGUMENT_WRONG after a line on standard error. Options and operands come in any order, each option once; "--" ends the options.
 * value: receives the value of the option, or the operand.
 */
int arguments_next(arguments *walk, const char **value);

/* Takes an option, or ARGUMENT_OPERAND, into a request. Returns an exit_code. */
typedef int take_argument(void *request, int which, const char *value);

/* Takes all arguments, up to the first that is wrong or asks for help, which walk->wants_help tells. Returns an exit_code. */
int arguments_read(arguments *walk, take_argument *take, void *request);

/* Takes the operand of a command that has one mesh. Returns an exit_code. */
int arguments_take_mesh(const char *operand, const char **mesh_path);

/* Takes --accuracy, --axes, --order or --kernel, by its name. Returns an exit_code. */
int options_read_test(const char *name, const char *value, tribox_options *test);

/* The words of an option's value. Each returns EXIT_CODE_OK, or another exit_code after a line on standard error. */
int options_read_accuracy(const char *text, tribox_accuracy *accuracy);
int options_read_axes(const char *text, unsigned *axes);
int options_read_order(const char *text, unsigned *order);
int options_read_kernel(const char *text, const char **kernel);

const char *options_accuracy_word(tribox_accuracy accuracy);

/* The i-th of the three groups of axes: its word and its TRIBOX_AXES_* bit. */
enum { OPTIONS_AXES_GROUPS = 3 };
const char *options_axes_word(int i, unsigned *bit);

#endif

/* options.h - the words that select a way of testing, and what else commands share. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "option_reader.h"
#include "tribox.h"

/* Lines of help that commands share. */
#define OPTIONS_TEST_HELP \
    "      --accuracy WORD     exact (default); conservative: never misses, may report more;\n" \
    "                          fast: single precision, may err close to contact\n" \
    "      --axes WORD,...     only some axes: box (3), plane (1), edges (9); fewer axes report more\n" \
    "      --kernel NAME       one that 'tribox info' lists; default: the widest\n"

#define OPTIONS_HELP_HELP "  -h, --help              print this text\n"

/* What a command says of itself, takes, and answers. */
typedef struct options_command {
    const char *help;
    const option_entry *table;
    option_taker *take;
    int (*answer)(void *request, const options_found *found); /* returns an exit_code */
} options_command;

/* Reads everything after words[0] into the request, and answers it, or prints the help. Returns an exit_code. */
int options_answer(const options_command *of, int count, char **words, void *request);

/* Of a second mesh where a command has one. Returns EXIT_CODE_USAGE. */
int options_refuse_file(const char *operand);

/* Takes the operand of a command that has one mesh. Returns an exit_code. */
int options_take_mesh(const char *operand, const char **mesh_path);

/* Takes the value of "accuracy", "axes", "order" or "kernel". Returns an exit_code. */
int options_read_test(const char *name, const char *value, tribox_options *test);

/* The i-th of the three groups of axes: its word and its TRIBOX_AXES_* bit. */
enum { OPTIONS_AXES_GROUPS = 3 };
const char *options_axes_word(int i, unsigned *bit);

#endif

/* arguments.h - the command line of a test program: the seed, how long to run, which scenes, where the meshes are. */
#ifndef TRIBOX_TESTS_ARGUMENTS_H
#define TRIBOX_TESTS_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct arguments {
    uint64_t seed;          /* --seed N, or the environment variable TRIBOX_TEST_SEED */
    size_t pairs;           /* pairs of a scene: 10^5, 10^7 with --long, 10^4 with --short */
    const char *scenes;     /* --scenes NAME: one scene, or one family of scenes; NULL for all */
    const char *named_case; /* --case NAME: of the program; NULL for all */
    const char *meshes;     /* --meshes FOLDER, or the environment variable TRIBOX_MESHES; NULL if neither is given */
} arguments;

/* Prints the seed. Ends the program with a message on an argument that it does not know. */
arguments arguments_parse(int argc, char **argv);

/* Whether --short asks for less than usual. */
static inline bool arguments_are_short(const arguments *args) { return args->pairs < 100000; }

/* How many rounds of that many pairs there are to run, at least one. */
size_t arguments_rounds(const arguments *args, size_t pairs_a_round);

#endif

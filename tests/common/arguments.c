#include "arguments.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAIRS = 100000, PAIRS_LONG = 10000000, PAIRS_SHORT = 10000 };

static const char usage[] = "usage: %s [--seed N] [--long | --short] [--scenes NAME] [--case NAME] [--meshes FOLDER]\n"
                            "  --seed N         the seed of everything drawn (default: TRIBOX_TEST_SEED, else 1)\n"
                            "  --long           ten million pairs a scene instead of a hundred thousand\n"
                            "  --short          ten thousand pairs a scene\n"
                            "  --scenes NAME    only this scene, or this family of scenes\n"
                            "  --case NAME      only this case of the program, such as test_lengths\n"
                            "  --meshes FOLDER  the folder of the mesh files (default: TRIBOX_MESHES)\n";

static uint64_t seed_of(const char *text)
{
    char *end;
    errno = 0;
    const unsigned long long seed = strtoull(text, &end, 0);
    if (errno || end == text || *end) {
        fprintf(stderr, "the seed '%s' is not a number from 0 to 2^64 - 1; give one, such as --seed 7\n", text);
        exit(2);
    }
    return seed;
}

size_t arguments_rounds(const arguments *args, size_t pairs_a_round)
{
    return args->pairs > pairs_a_round ? args->pairs / pairs_a_round : 1;
}

static const char *non_empty(const char *text) { return text && *text ? text : NULL; }

arguments arguments_parse(int argc, char **argv)
{
    const char *seed = non_empty(getenv("TRIBOX_TEST_SEED"));
    arguments args = {.pairs = PAIRS, .meshes = non_empty(getenv("TRIBOX_MESHES"))};
    for (int k = 1; k < argc; k++) {
        const char *const value = k + 1 < argc ? argv[k + 1] : NULL;
        if (!strcmp(argv[k], "--long") || !strcmp(argv[k], "--short")) {
            args.pairs = argv[k][2] == 'l' ? PAIRS_LONG : PAIRS_SHORT;
            continue;
        }
        const char **const option = !strcmp(argv[k], "--seed")     ? &seed
                                    : !strcmp(argv[k], "--scenes") ? &args.scenes
                                    : !strcmp(argv[k], "--case")   ? &args.named_case
                                    : !strcmp(argv[k], "--meshes") ? &args.meshes
                                                                   : NULL;
        if (!option || !value) {
            fprintf(stderr, "%s: argument '%s' %s\n", argv[0], argv[k], option ? "needs a value" : "is unknown");
            fprintf(stderr, usage, argv[0]);
            exit(2);
        }
        *option = value;
        k++;
    }
    args.seed = seed ? seed_of(seed) : 1;
    printf("seed %" PRIu64 "\n", args.seed);
    return args;
}

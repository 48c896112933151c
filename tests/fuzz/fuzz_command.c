/* fuzz_command.c - command lines, a word to a line, up to the mesh that they ask for, which is not there. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ensure.h"
#include "cmd.h"
#include "lines.h"
#include "console/message.h"

enum { WORDS_MAX = 64 };

/* Each word in memory of its own, so that nothing is read past its end. Returns how many there are. */
static int split(const char *text, size_t size, char *words[WORDS_MAX + 1])
{
    int count = 0;
    for (const char *end = text + size; text < end && count < WORDS_MAX; count++) {
        const char *const line_end = memchr(text, '\n', (size_t)(end - text));
        const size_t length = (size_t)((line_end ? line_end : end) - text);
        words[count] = malloc(length + 1);
        ensure(words[count], "no memory");
        memcpy(words[count], text, length);
        words[count][length] = '\0';
        text += length + (line_end != NULL);
    }
    words[count] = NULL;
    return count;
}

/* The command that the word begins; "overlap" for any other. */
static int run(const char *name, int count, char **words)
{
    return !strcmp(name, "voxelize")    ? cmd_voxelize(count, words)
           : !strcmp(name, "partition") ? cmd_partition(count, words)
           : !strcmp(name, "merge")     ? cmd_merge(count, words)
                                        : cmd_overlap(count, words);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static int is_quiet;
    char *words[WORDS_MAX + 1], *given[WORDS_MAX + 1];
    if (!is_quiet++)
        ensure(freopen("/dev/null", "w", stdout), "help cannot be sent away");
    const int count = split((const char *)data, size, words);
    if (count) {
        lines_forget();
        memcpy(given, words, sizeof given); /* the command moves them */
        lines_fit(words[0], run(words[0], count, given));
    }
    for (int i = 0; i < count; i++)
        free(words[i]);
    return 0;
}

/* accuracy.c - a table of accuracies and their words. */
#include "accuracy.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *word;
    tribox_accuracy accuracy;
} accuracies[] = {{"exact", TRIBOX_EXACT}, {"conservative", TRIBOX_CONSERVATIVE}, {"fast", TRIBOX_FAST}};

const char *accuracy_word(tribox_accuracy accuracy)
{
    size_t i = 0;
    while (accuracies[i].accuracy != accuracy)
        i++;
    return accuracies[i].word;
}

bool accuracy_of_word(const char *word, tribox_accuracy *accuracy)
{
    for (size_t i = 0; i < sizeof accuracies / sizeof accuracies[0]; i++)
        if (!strcmp(word, accuracies[i].word)) {
            *accuracy = accuracies[i].accuracy;
            return true;
        }
    return false;
}

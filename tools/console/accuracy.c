/* accuracy.c - a table of accuracies and their words. */
#include "accuracy.h"

#include <stddef.h>
#include <string.h>

#include "known_word.h"

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

int accuracy_read(const char *text, tribox_accuracy *accuracy)
{
    unsigned n;
    const int code = choice_read("--accuracy", text, strlen(text), "exact conservative fast", NULL, &n);
    if (!code)
        *accuracy = accuracies[n].accuracy;
    return code;
}

/* accuracy.h - the words for the accuracies, the same in options, answers and tables. */
#ifndef ACCURACY_H
#define ACCURACY_H

#include <stdbool.h>

#include "tribox.h"

const char *accuracy_word(tribox_accuracy accuracy);

/* The accuracy that the word stands for. False if it is none of these. */
bool accuracy_of_word(const char *word, tribox_accuracy *accuracy);

#endif

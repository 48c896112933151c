/* accuracy.h - the words for the accuracies, the same in options, answers and tables. */
#ifndef ACCURACY_H
#define ACCURACY_H

#include "tribox.h"

static inline const char *accuracy_word(tribox_accuracy accuracy)
{
    return accuracy == TRIBOX_EXACT ? "exact" : accuracy == TRIBOX_CONSERVATIVE ? "conservative" : "fast";
}

#endif

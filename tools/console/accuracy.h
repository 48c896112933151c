/* accuracy.h - the words for the accuracies, the same in options, answers and tables. */
#ifndef ACCURACY_H
#define ACCURACY_H

#include "tribox.h"

const char *accuracy_word(tribox_accuracy accuracy);

/* Reads what --accuracy has. Returns an exit_code. */
int accuracy_read(const char *text, tribox_accuracy *accuracy);

#endif

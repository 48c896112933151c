/* turns.h - equal pieces of a work, which threads take in turn. */
#ifndef TURNS_H
#define TURNS_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Calls work(data, thread, turn) for each turn from 0 to count - 1, rising, from as many threads. After one has returned false no
 * more are begun. Returns whether all returned true.
 */
bool turns_run(unsigned threads, size_t count, bool (*work)(void *data, unsigned thread, size_t turn), void *data);

#endif

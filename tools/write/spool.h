/* spool.h - a nameless file for what cannot go where it belongs yet: it vanishes with the program, however that ends. */
#ifndef SPOOL_H
#define SPOOL_H

#include "file_out.h"

/* Opens one on the disk of the output; for standard output where TMPDIR says, or in /tmp. NULL after a line. */
FILE *spool_open(const file_out *out);

/* Appends all of it to the output. Returns an exit_code. */
int spool_copy(FILE *spool, const file_out *out);

#endif

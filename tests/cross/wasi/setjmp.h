/* setjmp.h - where nothing can jump: what would, ends the program as skipped. */
#ifndef TRIBOX_TESTS_SETJMP_H
#define TRIBOX_TESTS_SETJMP_H

#include <stdlib.h>

typedef int jmp_buf;

static inline int setjmp(jmp_buf place)
{
    (void)place;
    return 0;
}

_Noreturn static inline void longjmp(jmp_buf place, int value)
{
    (void)place, (void)value;
    exit(77);
}

#endif

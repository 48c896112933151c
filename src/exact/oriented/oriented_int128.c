/* oriented_int128.c - oriented pairs in 128-bit integers, where the compiler has them. */
#include "oriented.h"
#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 vnum;
#include "exact/num_integer.h"
#include "kernel/axes.h"
#include "exact/integers.h"
#define ORIENTED_IN_INTEGERS tribox_oriented_int128
#include "oriented_pair.h"
#else
typedef int translation_unit_is_not_empty;
#endif

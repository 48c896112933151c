#include "oracle.h"

#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 int128;

/* The operations of GMP that separating.h uses, for numbers that are known to be short. */
typedef int128 num[1];
#define NUM(name) int128_##name

static void int128_init(int128 *a) { *a = 0; }
static void int128_set(int128 *r, const int128 *a) { *r = *a; }
static void int128_set_si(int128 *r, long a) { *r = a; }
static void int128_set_d(int128 *r, double a) { *r = (int128)(int64_t)a; }
static void int128_mul_2exp(int128 *r, const int128 *a, unsigned long shift) { *r = *a * ((int128)1 << shift); }
static void int128_add(int128 *r, const int128 *a, const int128 *b) { *r = *a + *b; }
static void int128_sub(int128 *r, const int128 *a, const int128 *b) { *r = *a - *b; }
static void int128_mul(int128 *r, const int128 *a, const int128 *b) { *r = *a * *b; }
static void int128_addmul(int128 *r, const int128 *a, const int128 *b) { *r += *a * *b; }
static void int128_submul(int128 *r, const int128 *a, const int128 *b) { *r -= *a * *b; }
static int int128_cmp(const int128 *a, const int128 *b) { return (*a > *b) - (*a < *b); }
static int int128_sgn(const int128 *a) { return (*a > 0) - (*a < 0); }

#include "separating.h"

oracle_axes oracle_separating_int128(const oracle_integers *in) { return separating(in); }
#else
typedef int translation_unit_is_not_empty;
#endif

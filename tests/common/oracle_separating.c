#include "oracle.h"

#include <gmp.h>

typedef mpz_t num;
#define NUM(name) mpz_##name
#include "separating.h"

oracle_axes oracle_separating_gmp(const pair_f64 *pair)
{
    const oracle_integers in = oracle_integers_of(pair);
    return separating(&in);
}

oracle_axes oracle_separating(const pair_f64 *pair)
{
    const oracle_integers in = oracle_integers_of(pair);
#if defined(__SIZEOF_INT128__)
    if (in.bits <= ORACLE_INT128_BITS)
        return oracle_separating_int128(&in);
#endif
    return separating(&in);
}

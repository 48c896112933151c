/*
 * inexact_flag.c - what inexact_flag.h says of sums, products and quotients that are exact, and of some that are not. Where the
 * flag is out of reach it says the same of all.
 */
#include <stdio.h>

#include "base/environment.h"
#include "base/inexact_flag.h"

#if defined(__SSE2__) || defined(__aarch64__)
enum { IS_IN_REACH = true };
#else
enum { IS_IN_REACH = false };
#endif

typedef struct calculation {
    const char *text;
    char operation;
    double a, b;
    bool is_exact;
} calculation;

static const calculation calculations[] = {
    {"1 + 2", '+', 1, 2, true},
    {"2^53 + 1", '+', 0x1p53, 1, false},
    {"2^53 + 2", '+', 0x1p53, 2, true},
    {"1 - 2^-53", '+', 1, -0x1p-53, true},
    {"1 + 2^-54", '+', 1, 0x1p-54, false},
    {"3 * 5", '*', 3, 5, true},
    {"(2^27 + 1)^2", '*', 0x1p27 + 1, 0x1p27 + 1, false},
    {"2^-600 * 2^-600", '*', 0x1p-600, 0x1p-600, false},
    {"1 / 4", '/', 1, 4, true},
    {"1 / 3", '/', 1, 3, false},
};

static bool is_kept(const calculation *c)
{
    const volatile double a = c->a, b = c->b;
    tribox_exactness_watch();
    const double result = c->operation == '+' ? a + b : c->operation == '*' ? a * b : a / b;
    return tribox_exactness_kept(result > 0);
}

int main(void)
{
    int status = 0;
    const tribox_environment callers = tribox_environment_enter();
    /* Twice: what one left behind must not be held against the next. */
    for (int round = 0; round < 2; round++)
        for (size_t k = 0; k < sizeof calculations / sizeof calculations[0]; k++) {
            const calculation *const c = &calculations[k];
            const bool kept = is_kept(c);
            if (kept == c->is_exact || (kept && !IS_IN_REACH))
                continue;
            fprintf(stderr, "%s is %sexact, but inexact_flag.h says %s\n", c->text, c->is_exact ? "" : "not ", kept ? "yes" : "no");
            status = 1;
        }
    tribox_environment_leave(callers);
    return status;
}

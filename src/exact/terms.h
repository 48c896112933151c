/*
 * terms.h - sums of products of differences of doubles, by their signs: in double where rounding cannot turn them, else in a sum as
 * long as it takes.
 */
#ifndef TRIBOX_EXACT_TERMS_H
#define TRIBOX_EXACT_TERMS_H

#define ACCUMULATOR_FACTORS 3
#include "accumulator.h"

/* A product of differences: those of the first two numbers, the next two and so on. */
enum { TERMS_MAX = 6 };
typedef struct exact_term {
    double difference[ACCUMULATOR_FACTORS][2];
} exact_term;

/* Neither so small nor so large that products of three differences underflow or overflow. */
static bool is_tame_number(double number)
{
    const double size = fabs(number);
    return size == 0 || (size >= 0x1p-200 && size <= 0x1p200);
}

static inline void set_difference(double difference[2], double from, double less)
{
    difference[0] = from;
    difference[1] = less;
}

/*
 * Whether the sum of the terms has the sign that double finds: a term is rounded five times at most, and there are five sums
 * (PROOFS.md 9.3).
 */
static bool is_certain_in_double(const exact_term term[], int terms, int factors, int *sign)
{
    double sum = 0, size = 0;
    for (int k = 0; k < terms; k++) {
        double product = 1;
        for (int f = 0; f < factors; f++)
            product *= term[k].difference[f][0] - term[k].difference[f][1];
        sum += product;
        size += fabs(product);
    }
    *sign = (sum > 0) - (sum < 0);
    return fabs(sum) >= 0x1p-49 * size;
}

/* Every product of one number from each difference, those of the second numbers negative. */
static void add_term(accumulator *sum, const exact_term *term, int factors)
{
    for (int f = 0; f < factors; f++)
        if (term->difference[f][0] == term->difference[f][1])
            return;
    for (int choice = 0; choice < 1 << factors; choice++) {
        double factor[ACCUMULATOR_FACTORS];
        bool is_zero = false;
        for (int f = 0; f < factors; f++) {
            const bool is_second = choice >> f & 1;
            factor[f] = is_second ? -term->difference[f][1] : term->difference[f][0];
            is_zero = is_zero || factor[f] == 0;
        }
        if (!is_zero)
            accumulator_add(sum, factor, factors);
    }
}

static int sign_of_sum(const exact_term term[], int terms, int factors, bool is_tame)
{
    int sign;
    if (is_tame && is_certain_in_double(term, terms, factors, &sign))
        return sign;
    accumulator sum;
    accumulator_clear(&sum);
    for (int k = 0; k < terms; k++)
        add_term(&sum, &term[k], factors);
    return accumulator_sign(&sum);
}

#endif

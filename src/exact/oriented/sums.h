/*
 * sums.h - sums of products of up to three places or lengths in a frame, by their signs: in double where rounding cannot turn them,
 * else in a sum as long as it takes.
 */
#ifndef TRIBOX_EXACT_SUMS_H
#define TRIBOX_EXACT_SUMS_H

/* Three places, each of products of two numbers. */
#define ACCUMULATOR_FACTORS 6
#include "base/floats.h"
#include "exact/accumulator.h"

/* A place in the frame: the sum of the products part[n][0] * part[n][1], none of which is zero. */
enum { PLACE_PARTS = 7 };
typedef struct exact_place {
    double value, size; /* in double: the sum, and that of the sizes of what it is made of */
    double part[PLACE_PARTS][2];
    int parts;
} exact_place;

/* A product of places, subtracted or added. */
enum { PRODUCT_PLACES = 3 };
typedef struct exact_product {
    const exact_place *place[PRODUCT_PLACES];
    bool is_subtracted;
} exact_product;

/* Products of three places do not underflow or overflow in double (PROOFS.md 9.5). */
static bool is_tame_in_frame(double number)
{
    const double size = fabs(number);
    return size == 0 || (size >= 0x1p-120 && size <= 0x1p120);
}

static void add_part(exact_place *place, double a, double b)
{
    if (a == 0 || b == 0)
        return;
    place->part[place->parts][0] = a;
    place->part[place->parts++][1] = b;
}

/* Adds axis * (from - less): one part where the difference is a double, as it is of most floats. */
static void add_difference(exact_place *place, double axis, double from, double less)
{
    const double difference = from - less;
    if (tribox_lost_by_difference(from, less) == 0) {
        add_part(place, axis, difference);
    } else {
        add_part(place, axis, from);
        add_part(place, -axis, less);
    }
    place->value += axis * difference;
    place->size += fabs(axis * difference);
}

static void add_number(exact_place *place, double number)
{
    add_part(place, number, 1);
    place->value += number;
    place->size += fabs(number);
}

/* Rounding turns no sign of a sum this large: it is off by 20.1 u of the sizes at most (PROOFS.md 9.5). */
static bool is_sign_in_double(const exact_product product[], int products, int places, int *sign)
{
    double sum = 0, size = 0;
    for (int k = 0; k < products; k++) {
        double value = 1, of_sizes = 1;
        for (int f = 0; f < places; f++) {
            value *= product[k].place[f]->value;
            of_sizes *= product[k].place[f]->size;
        }
        sum += product[k].is_subtracted ? -value : value;
        size += of_sizes;
    }
    *sign = (sum > 0) - (sum < 0);
    return fabs(sum) >= 0x1p-48 * size;
}

/* Every product of one part of each place. */
static void add_product(accumulator *sum, const exact_product *product, int places)
{
    int choice[PRODUCT_PLACES] = {0};
    for (int f = 0; f < places; f++)
        if (!product->place[f]->parts)
            return;
    for (int f = 0; f < places;) {
        double factor[ACCUMULATOR_FACTORS];
        for (f = 0; f < places; f++) {
            factor[2 * f] = product->place[f]->part[choice[f]][0];
            factor[2 * f + 1] = product->place[f]->part[choice[f]][1];
        }
        factor[0] = product->is_subtracted ? -factor[0] : factor[0];
        accumulator_add(sum, factor, 2 * places);
        for (f = 0; f < places && ++choice[f] == product->place[f]->parts; f++) /* the next choice, as one counts */
            choice[f] = 0;
    }
}

/* is_tame: no product underflows or overflows in double. */
static int sign_of_products(bool is_tame, const exact_product product[], int products, int places)
{
    int sign = 0;
    if (is_tame && is_sign_in_double(product, products, places, &sign))
        return sign;
    accumulator sum;
    accumulator_clear(&sum);
    for (int k = 0; k < products; k++)
        add_product(&sum, &product[k], places);
    return accumulator_sign(&sum);
}

#endif

/* scenes_f64_range.c - the ends of the range of doubles, and exponents from one end to the other in one pair. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "contact_f64.h"

typedef double number_draw(random_source *r);

static void draw_numbers(random_source *r, batch_f64 *batch, number_draw *draw)
{
    for (int k = 0; k < BATCH_F64; k++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                batch->u[k][j][a] = draw(r);
}

static void draw_bounds(random_source *r, batch_f64 *batch, number_draw *draw)
{
    for (int a = 0; a < 3; a++) {
        const double x = draw(r), y = draw(r);
        batch->box.lo[a] = x < y ? x : y;
        batch->box.hi[a] = x < y ? y : x;
    }
}

static double any_exponent(random_source *r)
{
    const double x = random_double(r, -2, 2);
    return ldexp(x, random_int_between(r, -1000, 1000));
}

void draw_f64_range(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, any_exponent);
    draw_numbers(r, batch, any_exponent);
}

static double few_of_the_least(random_source *r) { return ldexp(random_int_between(r, -2048, 2048), -1074); }

void draw_f64_subnormal(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, few_of_the_least);
    draw_numbers(r, batch, few_of_the_least);
}

static double up_to_max(random_source *r) { return random_double(r, -1, 1) * DBL_MAX; }

void draw_f64_near_max(random_source *r, batch_f64 *batch)
{
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = -0.4 * DBL_MAX;
        batch->box.hi[a] = 0.5 * DBL_MAX;
    }
    draw_numbers(r, batch, up_to_max);
}

/* Differences beyond the greatest double, of the box or of the vertices alone. */
static double greatest_or_few(random_source *r)
{
    static const double numbers[] = {DBL_MAX, -DBL_MAX, DBL_MAX / 2, -DBL_MAX / 2, 0x1p1023, -0x1p1023, 1, -1, 0, 0.5};
    return numbers[random_int(r, 10)];
}

void draw_f64_overflow(random_source *r, batch_f64 *batch)
{
    if (random_int(r, 2))
        batch->box = box_f64_about_zero(r, 0.5, 2);
    else
        draw_bounds(r, batch, greatest_or_few);
    draw_numbers(r, batch, greatest_or_few);
}

/* Contact in units of their own. */
static void draw_units(random_source *r, batch_f64 *batch, int least, int most)
{
    int exponent[3];
    for (int a = 0; a < 3; a++)
        exponent[a] = random_int_between(r, least, most);
    draw_f64_touching_ulp(r, batch);
    place_f64(batch, exponent, (const double[]){0, 0, 0});
}

void draw_f64_units(random_source *r, batch_f64 *batch)
{
    const int most = random_int(r, 2) ? 300 : 1000;
    draw_units(r, batch, -most, most);
}

/* About 2^-200 and 2^200, between which the second stage takes numbers. */
void draw_f64_stage_ends(random_source *r, batch_f64 *batch)
{
    const int end = random_int(r, 2) ? 200 : -200;
    draw_units(r, batch, end - 3, end + 3);
}

static double nasty_number(random_source *r)
{
    static const double numbers[] = {0,        1,        0x1p-1074, DBL_MIN,  DBL_MAX,  0x1p-36,  0x1p36,   0x1p-200,
                                     0x1p200,  0x1p127,  0x1p128,   0x1p-126, 0x1p-149, 0x1p-150, 0x1p-151, 0x1p1022,
                                     0x1p-540, 0x1p-380, 0x1p24,    0x1p53,   3,        1.5};
    const double number = numbers[random_int(r, sizeof numbers / sizeof numbers[0])];
    const int steps = number < DBL_MAX ? random_int_between(r, -1, 1) : 0;
    return stepped_f64(random_int(r, 2) ? number : -number, steps);
}

void draw_f64_nasty(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, nasty_number);
    draw_numbers(r, batch, nasty_number);
}

/* Any bits that are a number. */
static double any_bits(random_source *r)
{
    double number;
    do {
        const uint64_t bits = random_bits(r);
        memcpy(&number, &bits, sizeof number);
    } while (!isfinite(number));
    return number;
}

void draw_f64_bits(random_source *r, batch_f64 *batch)
{
    draw_bounds(r, batch, any_bits);
    draw_numbers(r, batch, any_bits);
}

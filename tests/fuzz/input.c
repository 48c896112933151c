#include "things.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The ways in which a number is written. */
enum { BITS, LATTICE, FAR_LATTICE, NEAR_KNOWN, BETWEEN_KNOWN, NASTY, POWER, ANY_WAY, WAYS };

bool input_is_over(const input *in) { return in->at == in->end; }

unsigned input_byte(input *in) { return input_is_over(in) ? 0 : *in->at++; }

unsigned input_below(input *in, unsigned count) { return input_byte(in) % count; }

size_t input_count(input *in)
{
    const unsigned choice = input_byte(in);
    return choice == 255 ? COUNT_MAX : choice < 160 ? choice % 20 : choice - 120;
}

input input_of(const uint8_t *data, size_t size)
{
    input in = {.at = data, .end = data + size, .knowns = 1};
    in.unit = input_below(&in, 8);
    in.is_lattice = in.unit < 4;
    return in;
}

static double any_bits(input *in)
{
    uint64_t bits = 0;
    const unsigned bytes = in->is_wide ? 8 : 4;
    for (unsigned k = 0; k < bytes; k++)
        bits |= (uint64_t)input_byte(in) << 8 * k;
    const uint32_t half = (uint32_t)bits;
    double number;
    float narrow;
    memcpy(&number, &bits, sizeof number);
    memcpy(&narrow, &half, sizeof narrow);
    return in->is_wide ? number : (double)narrow;
}

static double any_known(input *in) { return in->known[input_below(in, in->knowns)]; }

/* A few numbers up or down; a double also off by some of what a float of it rounds. */
static double near_known(input *in)
{
    double number = any_known(in);
    const unsigned choice = input_below(in, in->is_wide ? 14 : 7);
    if (choice >= 7)
        return number + number * ((double)choice - 10) * 0x1p-25;
    for (int steps = abs((int)choice - 3); steps; steps--) {
        const double to = choice < 3 ? -INFINITY : INFINITY;
        number = in->is_wide ? nextafter(number, to) : (double)nextafterf((float)number, (float)to);
    }
    return number;
}

/* A quarter of the way, half, or a way beyond. */
static double between_known(input *in)
{
    const double from = any_known(in), to = any_known(in);
    return from + (to - from) * ((double)input_below(in, 9) * 0.25 - 0.5);
}

static double nasty(input *in)
{
    static const double numbers[2][16] = {
        {0, FLT_MIN, 0x1p-149, 0x1.fffffcp-127, FLT_MAX, FLT_MAX / 2, 0x1p24, 0x1.fffffep23, 0x1p40, 0x1p-110, 0x1p-55, 0x1p120,
         0x1p-120, 1, INFINITY, NAN},
        {0, DBL_MIN, 0x1p-1074, DBL_MAX, DBL_MAX / 2, 0x1p-36, 0x1p36, 0x1p-200, 0x1p200, 0x1p127, 0x1p-149, 0x1p-150, 1, 0x1p1023,
         INFINITY, NAN},
    };
    const unsigned choice = input_byte(in);
    const double number = numbers[in->is_wide][choice & 15];
    return choice & 16 ? -number : number;
}

static double near_power(input *in)
{
    const int exponent = (int)input_byte(in), digits = (int)input_byte(in);
    const double number = ldexp(1 + (double)(digits & 15) / 16, in->is_wide ? 8 * exponent - 1022 : exponent - 127);
    return digits & 128 ? -number : number;
}

static double unit_of(const input *in)
{
    static const int exponents[2][8] = {{0, -3, 10, -20, 60, -60, 118, -149}, {0, -3, 10, -40, 36, -36, 600, -1074}};
    return ldexp(1, exponents[in->is_wide][in->unit]);
}

static double few_units(input *in) { return ((double)(input_byte(in) & 31) - 16) * unit_of(in); }

/* Longer or shorter integers. */
static double far_units(input *in)
{
    static const double offsets[2][8] = {{0x1p20, 0x1p5, 0x1p8, 0x1p10, 0x1p12, 0x1p16, 0x1p18, 0x1p22},
                                         {0x1p52, 1e7, 0x1p30, 4.6e6, 0x1p24, 0.1, 1e9, 0x1p40}};
    const unsigned byte = input_byte(in);
    return ((double)(byte & 31) - 16 + offsets[in->is_wide][byte >> 5]) * unit_of(in);
}

static double written(input *in, unsigned way)
{
    if (way == ANY_WAY)
        way = input_below(in, ANY_WAY);
    in->is_lattice = in->is_lattice && way == LATTICE && !in->is_wide;
    switch (way) {
    case LATTICE:
        return few_units(in);
    case FAR_LATTICE:
        return far_units(in);
    case NEAR_KNOWN:
        return near_known(in);
    case BETWEEN_KNOWN:
        return between_known(in);
    case NASTY:
        return nasty(in);
    case POWER:
        return near_power(in);
    default:
        return any_bits(in);
    }
}

static double number_written(input *in, unsigned way)
{
    const double number = written(in, way);
    return in->is_wide ? number : (double)(float)number;
}

void input_remember(input *in, double number)
{
    if (in->knowns < INPUT_KNOWN)
        in->known[in->knowns++] = number;
}

void input_numbers(input *in, double *numbers, int count)
{
    const unsigned way = input_below(in, WAYS);
    for (int k = 0; k < count; k++)
        numbers[k] = number_written(in, way);
    for (int k = 0; k < count; k++)
        input_remember(in, numbers[k]);
}

void move_up(double *numbers, int count, unsigned steps)
{
    for (; steps; steps--)
        for (int k = 0; k < count; k++)
            numbers[k] = isfinite(numbers[k]) ? nextafter(numbers[k], INFINITY) : numbers[k];
}

/* What a byte, past its three bits of the way, makes of a triangle: the segment, the point, or flat along an axis. */
static void make_degenerate(double u[3][3], unsigned shape)
{
    for (int a = 0; a < 3; a++) {
        if (shape == 1)
            u[2][a] = 0.5 * (u[0][a] + u[1][a]);
        else if (shape == 2)
            u[1][a] = u[2][a] = u[0][a];
        else if (shape == 3 + (unsigned)a)
            u[1][a] = u[2][a] = u[0][a];
    }
}

void input_triangle(input *in, double u[3][3])
{
    const unsigned kind = input_byte(in);
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            u[v][a] = number_written(in, kind % WAYS);
    make_degenerate(u, kind / WAYS % 8);
    for (int k = 0; k < 9; k++) {
        double *const x = &u[k / 3][k % 3];
        *x = in->is_wide ? *x : (double)(float)*x;
        input_remember(in, *x);
    }
}

/* Bits of a box's first byte after those of the way: axis a is flat where bit a is set; NO_ORDER leaves the bounds as drawn. */
enum { NO_ORDER = 8 };

tribox_box input_box(input *in)
{
    tribox_box box;
    const unsigned kind = input_byte(in), shape = kind / WAYS;
    for (int a = 0; a < 3; a++) {
        const double one = number_written(in, kind % WAYS), other = number_written(in, kind % WAYS);
        const bool is_turned = one > other && !(shape & NO_ORDER);
        box.lo[a] = is_turned ? other : one;
        box.hi[a] = shape >> a & 1 ? box.lo[a] : is_turned ? one : other;
        input_remember(in, box.lo[a]);
        input_remember(in, box.hi[a]);
    }
    return box;
}

/* The rotation of a quaternion of four small numbers, rounded. */
static void draw_rotation(input *in, double axis[3][3])
{
    double q[4], square = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = (double)input_byte(in) - 127.5;
        square += q[k] * q[k];
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        axis[k][k] = 1 - 2 * (q[a] * q[a] + q[b] * q[b]) / square;
        axis[k][a] = 2 * (q[k] * q[a] + q[b] * q[3]) / square;
        axis[k][b] = 2 * (q[k] * q[b] - q[a] * q[3]) / square;
    }
    for (int k = 0; k < 9 && !in->is_wide; k++)
        axis[k / 3][k % 3] = (double)(float)axis[k / 3][k % 3];
}

tribox_oriented_box input_oriented(input *in)
{
    tribox_oriented_box box;
    input_numbers(in, box.center, 3);
    input_numbers(in, box.half, 3);
    const bool is_rotation = input_byte(in) & 1;
    if (is_rotation)
        draw_rotation(in, box.axis);
    else
        input_numbers(in, box.axis[0], 9);
    for (int k = 0; k < 3; k++) /* a negative half length makes the whole box empty: enough for one byte in sixteen */
        if (input_byte(in) % 16)
            box.half[k] = fabs(box.half[k]);
    return box;
}

tribox_options input_options(input *in)
{
    static const unsigned orders[] = {0, 123, 132, 213, 231, 312, 321};
    const unsigned axes = input_byte(in) & 7;
    return (tribox_options){.axes = axes, .axis_order = orders[input_below(in, sizeof orders / sizeof orders[0])]};
}

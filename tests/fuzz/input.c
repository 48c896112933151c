#include "input.h"

#include <float.h>
#include <math.h>
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
    static const int exponents[] = {0, -3, 10, -20, 60, -60, 118, -149};
    input in = {.at = data, .end = data + size, .knowns = 1};
    const unsigned choice = input_below(&in, sizeof exponents / sizeof exponents[0]);
    in.unit = ldexpf(1, exponents[choice]);
    in.is_lattice = choice < 4;
    return in;
}

static float float_of(uint32_t bits)
{
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static float any_bits(input *in)
{
    uint32_t bits = 0;
    for (int k = 0; k < 4; k++)
        bits |= (uint32_t)input_byte(in) << 8 * k;
    return float_of(bits);
}

/* So many floats up or down; past the greatest one to infinity and NaN. */
static float stepped(float number, int steps)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    int64_t place = bits >> 31 ? -(int64_t)(bits & 0x7fffffff) : (int64_t)bits;
    place += steps;
    return place < 0 ? -float_of((uint32_t)-place) : float_of((uint32_t)place);
}

static float any_known(input *in) { return in->known[input_below(in, in->knowns)]; }

static float near_known(input *in)
{
    const float known = any_known(in);
    return stepped(known, (int)input_below(in, 7) - 3);
}

/* A quarter of the way, half, or a way beyond. */
static float between_known(input *in)
{
    const float from = any_known(in), to = any_known(in);
    return from + (to - from) * ((float)input_below(in, 9) * 0.25f - 0.5f);
}

static float nasty(input *in)
{
    static const float numbers[] = {
        0,       FLT_MIN,   0x1p-149f, 0x1.fffffcp-127f, FLT_MAX,   FLT_MAX / 2, 0x1p24f,  0x1.fffffep23f,
        0x1p40f, 0x1p-110f, 0x1p-55f,  0x1p120f,         0x1p-120f, 1,           INFINITY, NAN};
    const unsigned choice = input_byte(in);
    const float number = numbers[choice & 15];
    return choice & 16 ? -number : number;
}

static float near_power(input *in)
{
    const unsigned exponent = input_byte(in), digits = input_byte(in);
    const float number = ldexpf(1 + (float)(digits & 15) * 0x1p-4f, (int)exponent - 127);
    return digits & 128 ? -number : number;
}

static float few_units(input *in) { return ((float)(input_byte(in) & 31) - 16) * in->unit; }

/* Longer or shorter integers. */
static float far_units(input *in)
{
    static const float offsets[] = {0x1p20f, 0x1p5f, 0x1p8f, 0x1p10f, 0x1p12f, 0x1p16f, 0x1p18f, 0x1p22f};
    const unsigned byte = input_byte(in);
    return ((float)(byte & 31) - 16 + offsets[byte >> 5]) * in->unit;
}

static float number_written(input *in, unsigned way)
{
    if (way == ANY_WAY)
        way = input_below(in, ANY_WAY);
    in->is_lattice = in->is_lattice && way == LATTICE;
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

void input_remember(input *in, float number)
{
    if (in->knowns < INPUT_KNOWN)
        in->known[in->knowns++] = number;
}

void input_numbers(input *in, float *numbers, int count)
{
    const unsigned way = input_below(in, WAYS);
    for (int k = 0; k < count; k++)
        numbers[k] = number_written(in, way);
    for (int k = 0; k < count; k++)
        input_remember(in, numbers[k]);
}

void input_doubles(input *in, double numbers[3])
{
    float floats[3];
    input_numbers(in, floats, 3);
    for (int n = 0; n < 3; n++)
        numbers[n] = (double)floats[n];
}

void move_up(double *numbers, int count, unsigned steps)
{
    for (; steps; steps--)
        for (int k = 0; k < count; k++)
            numbers[k] = isfinite(numbers[k]) ? nextafter(numbers[k], INFINITY) : numbers[k];
}

/* What a byte, past its three bits of the way, makes of a triangle: the segment, the point, or flat along an axis. */
static void make_degenerate(float u[3][3], unsigned shape)
{
    for (int a = 0; a < 3; a++) {
        if (shape == 1)
            u[2][a] = 0.5f * (u[0][a] + u[1][a]);
        else if (shape == 2)
            u[1][a] = u[2][a] = u[0][a];
        else if (shape == 3 + (unsigned)a)
            u[1][a] = u[2][a] = u[0][a];
    }
}

void input_triangle(input *in, float u[3][3])
{
    const unsigned kind = input_byte(in);
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            u[v][a] = number_written(in, kind % WAYS);
    make_degenerate(u, kind / WAYS % 8);
    for (int k = 0; k < 9; k++)
        input_remember(in, u[k / 3][k % 3]);
}

/* Bits of a box's first byte after those of the way: axis a is flat where bit a is set; NO_ORDER leaves the bounds as drawn. */
enum { NO_ORDER = 8 };

tribox_box input_box(input *in)
{
    tribox_box box;
    const unsigned kind = input_byte(in), shape = kind / WAYS;
    for (int a = 0; a < 3; a++) {
        const float one = number_written(in, kind % WAYS), other = number_written(in, kind % WAYS);
        const bool is_turned = one > other && !(shape & NO_ORDER);
        box.lo[a] = is_turned ? other : one;
        box.hi[a] = shape >> a & 1 ? box.lo[a] : is_turned ? one : other;
        input_remember(in, (float)box.lo[a]);
        input_remember(in, (float)box.hi[a]);
    }
    return box;
}

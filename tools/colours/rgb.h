/* rgb.h - colours as bytes of red, green and blue, as pictures have them (sRGB), and how numbers and means become such. */
#ifndef RGB_H
#define RGB_H

#include <stdbool.h>
#include <stdint.h>

typedef struct rgb {
    unsigned char at[3];
} rgb;

/* Of a triangle that has none: the grey that files of materials have where they say nothing. */
#define RGB_GREY ((rgb){{204, 204, 204}})

/* Numbers from 0 to `most` become bytes, rounded to the nearest. What lies beyond becomes the end; NaN becomes 0. */
static inline rgb rgb_of(const double number[3], double most)
{
    rgb colour;
    for (int c = 0; c < 3; c++) {
        const double byte = number[c] / most * 255 + 0.5;
        colour.at[c] = (unsigned char)(!(byte > 0) ? 0 : byte < 255 ? byte : 255);
    }
    return colour;
}

/* Light, each from 0 to 1, as the nearest bytes of sRGB. */
rgb rgb_of_light(const double light[3]);

/* Each byte of sRGB as light, from 0 to 1. */
typedef struct rgb_curve {
    float light[256];
} rgb_curve;

rgb_curve rgb_curve_make(void);

/* As one number, for comparisons. */
static inline uint32_t rgb_number(rgb colour) { return (uint32_t)colour.at[0] << 16 | (uint32_t)colour.at[1] << 8 | colour.at[2]; }

static inline rgb rgb_of_number(uint32_t number)
{
    return (rgb){{(unsigned char)(number >> 16), (unsigned char)(number >> 8), (unsigned char)number}};
}

/* For a mean. */
typedef struct rgb_sum {
    uint64_t at[3], count;
} rgb_sum;

static inline void rgb_add(rgb_sum *sum, rgb colour)
{
    for (int c = 0; c < 3; c++)
        sum->at[c] += colour.at[c];
    sum->count++;
}

/* The nearest bytes; a half goes up. Of none it is the grey. */
static inline rgb rgb_mean(const rgb_sum *sum)
{
    rgb mean = RGB_GREY;
    for (int c = 0; c < 3 && sum->count; c++)
        mean.at[c] = (unsigned char)((2 * sum->at[c] + sum->count) / (2 * sum->count));
    return mean;
}

#endif

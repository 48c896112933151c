/* rgb.c - the curve of sRGB: IEC 61966-2-1. */
#include "rgb.h"

#include <math.h>

rgb_curve rgb_curve_make(void)
{
    rgb_curve curve;
    for (int byte = 0; byte < 256; byte++) {
        const double s = byte / 255.0;
        curve.light[byte] = (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4));
    }
    return curve;
}

rgb rgb_of_light(const double light[3])
{
    double number[3];
    for (int c = 0; c < 3; c++)
        number[c] = light[c] <= 0.0031308 ? 12.92 * light[c] : 1.055 * pow(light[c], 1 / 2.4) - 0.055;
    return rgb_of(number, 1);
}

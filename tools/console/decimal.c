/* decimal.c - tries one digit after the other until the number is found again. */
#include "decimal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Writes a number that `digits` digits after the first tell apart from others. */
static const char *write(double number, int digits, char text[DECIMAL_MAX])
{
    const char *const exponent = strchr(text, 'e');
    const int places = exponent ? digits - atoi(exponent + 1) : 0;
    const double size = fabs(number);
    if (size == 0 || (size >= (double)1e-5f && size < 1e9))
        snprintf(text, DECIMAL_MAX, "%.*f", places > 0 ? places : 0, number);
    return text;
}

const char *decimal_of(float number, char text[DECIMAL_MAX])
{
    int digits;
    for (digits = 0; digits < 9; digits++) {
        snprintf(text, DECIMAL_MAX, "%.*e", digits, (double)number);
        if (strtof(text, NULL) == number)
            break;
    }
    return write((double)number, digits, text);
}

const char *decimal_of_double(double number, char text[DECIMAL_MAX])
{
    int digits;
    for (digits = 0; digits < 17; digits++) {
        snprintf(text, DECIMAL_MAX, "%.*e", digits, number);
        if (strtod(text, NULL) == number)
            break;
    }
    return write(number, digits, text);
}

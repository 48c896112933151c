/* decimal.c - tries one digit after the other until the float is found again. */
#include "decimal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *decimal_of(float number, char text[DECIMAL_MAX])
{
    int digits; /* after the first */
    for (digits = 0; digits < 9; digits++) {
        snprintf(text, DECIMAL_MAX, "%.*e", digits, (double)number);
        if (strtof(text, NULL) == number)
            break;
    }
    const float size = fabsf(number);
    const char *const exponent = strchr(text, 'e');
    const int places = exponent ? digits - atoi(exponent + 1) : 0;
    if (size == 0 || (size >= 1e-5f && size < 1e9f))
        snprintf(text, DECIMAL_MAX, "%.*f", places > 0 ? places : 0, (double)number);
    return text;
}

/* decimal.c - tries one digit after the other until the number is found again; chooses units that fit. */
#include "written_number.h"

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

const char *decimal_of(double number, bool is_float, char text[DECIMAL_MAX])
{
    const int most = is_float ? 9 : 17;
    int digits;
    for (digits = 0; digits < most; digits++) {
        snprintf(text, DECIMAL_MAX, "%.*e", digits, number);
        if ((is_float ? (double)strtof(text, NULL) : strtod(text, NULL)) == number)
            break;
    }
    return write(number, digits, text);
}

const char *decimals_of(const double number[3], char between, char text[3 * DECIMAL_MAX])
{
    char *to = text;
    for (int n = 0; n < 3; n++) {
        to += strlen(decimal_of_double(number[n], to));
        *to++ = n < 2 ? between : '\0';
    }
    return text;
}

const char *duration_text(double seconds, char text[DURATION_MAX])
{
    const double minutes = seconds / 60;
    if (seconds < 1)
        snprintf(text, DURATION_MAX, "%.3f ms", 1e3 * seconds);
    else if (minutes < 10)
        snprintf(text, DURATION_MAX, "%.1f s", seconds);
    else if (minutes < 60)
        snprintf(text, DURATION_MAX, "%.0f min", minutes);
    else
        snprintf(text, DURATION_MAX, "%.0f h %02.0f min", (double)(int)(minutes / 60), (double)((int)minutes % 60));
    return text;
}

const char *duration_count(double count, char text[DURATION_MAX])
{
    static const char *const units[] = {"", " thousand", " million", " billion", " trillion"};
    int unit = 0;
    for (; count >= 999.5 && unit < 4; unit++)
        count /= 1000;
    snprintf(text, DURATION_MAX, unit && count < 9.95 ? "%.1f%s" : "%.0f%s", count, units[unit]);
    return text;
}

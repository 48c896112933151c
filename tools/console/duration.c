/* duration.c - writes times and large counts with a unit that fits. */
#include "duration.h"

#include <stdio.h>

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

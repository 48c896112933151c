/* numbers.c - reads numbers, and says which one is wrong and why. */
#include "numbers.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "system.h"
#include "written_number.h"

/* Reads number `position`, counted from 0, that the whole of text[0 .. length) spells. */
static bool read_number(const char *text, size_t length, const char *where, int position, int count, double *to, unsigned *decimals)
{
    const int shown = length < 40 ? (int)length : 40, n = position + 1;
    double number = 0;
    float_fit fit = FLOAT_FIT_NONE;
    errno = 0;
    const bool is_number = written_number_read(text, length, &number, &fit), is_out_of_range = errno == ERANGE;
    if (!is_number)
        message_say("%s: '%.*s' (number %d of %d) is not a number; write it like -0.5 or 1e-3", where, shown, text, n, count);
    else if (is_out_of_range && isinf(number))
        message_say("%s: '%.*s' (number %d of %d) is too large for double, which ends at %.9g", where, shown, text, n, count,
                    DBL_MAX);
    else if (!isfinite(number))
        message_say("%s: '%.*s' (number %d of %d) is not finite; bounds are finite numbers", where, shown, text, n, count);
    else if (is_out_of_range && number == 0)
        message_say("%s: '%.*s' (number %d of %d) is too small for double; give 0 or at least 4.9e-324", where, shown, text, n,
                    count);
    else {
        *to = number;
        *decimals |= (unsigned)(fit == FLOAT_FIT_DECIMAL) << position;
        return true;
    }
    return false;
}

bool numbers_read(const char *text, const char *where, const char *form, int count, double *numbers, unsigned *decimals)
{
    bool is_due = true; /* a number must follow, as at the start and after a comma */
    int found = 0;
    unsigned of_floats = 0;
    for (text += strspn(text, NUMBERS_BLANKS); *text || is_due; text += strspn(text, NUMBERS_BLANKS)) {
        const size_t length = strcspn(text, NUMBERS_BLANKS ",");
        if (found == count) {
            message_say("%s: more than %d number%s; give %s", where, count, count == 1 ? "" : "s", form);
            return false;
        }
        if (!length) {
            message_say("%s: number %d of %d is missing; give %s", where, found + 1, count, form);
            return false;
        }
        if (!read_number(text, length, where, found, count, &numbers[found], &of_floats))
            return false;
        found++;
        text += length;
        text += strspn(text, NUMBERS_BLANKS);
        is_due = *text == ',';
        text += is_due;
    }
    if (found < count) {
        const bool is_option = !strncmp(where, "--", 2);
        message_say("%s: %d number%s where %d are needed; give %s%s", where, found, found == 1 ? "" : "s", count, form,
                    is_option ? ", with commas, or blanks in quotes" : "");
        return false;
    }
    if (decimals)
        *decimals = of_floats;
    return true;
}

void numbers_round(double *numbers, int count, unsigned decimals)
{
    for (int i = 0; i < count; i++)
        if (decimals >> i & 1)
            numbers[i] = (double)(float)numbers[i];
}

bool numbers_are_floats(const double *numbers, int count)
{
    bool are_floats = true;
    for (int i = 0; i < count; i++)
        are_floats &= float_fit_of(numbers[i]) == FLOAT_FIT_EXACT;
    return are_floats;
}

/* Reads digits; *end is where they end. Returns 0, which every caller refuses, where there are none or the number is too large. */
static uint32_t read_digits(const char *text, uint32_t most, const char **end)
{
    uint64_t number = 0;
    for (*end = text; **end >= '0' && **end <= '9'; ++*end)
        number = number > most ? number : 10 * number + (uint64_t)(**end - '0');
    return number > most ? 0 : (uint32_t)number;
}

int numbers_read_whole(const char *text, const char *option, uint32_t most, uint32_t *number)
{
    const char *end;
    *number = read_digits(text, most, &end);
    return *number && !*end ? EXIT_CODE_OK : message_usage("%s: '%s' is not a whole number from 1 to %u", option, text, most);
}

int numbers_read_memory(const char *text, uint64_t *bytes)
{
    return memory_read(text, bytes) ? EXIT_CODE_OK : message_usage("--memory: '%s' is no size, such as 512M or 1G", text);
}

int numbers_read_sizes(const char *text, const char *option, uint32_t most, uint32_t sizes[3])
{
    const char *end = text;
    for (int a = 0; a < 3; a++) {
        sizes[a] = read_digits(a ? end + 1 : end, most, &end);
        if (!sizes[a] || *end != (a < 2 ? ',' : '\0'))
            return message_usage("%s: '%s' is not NX,NY,NZ, three whole numbers from 1 to %u", option, text, most);
    }
    return EXIT_CODE_OK;
}

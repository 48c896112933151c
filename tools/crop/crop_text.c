/* crop_text.c - copies text between words that are replaced. Lines end in LF, CR LF or CR. */
#include "crop_text.h"

enum { DIGITS_MOST = 20 /* of 2^64 - 1 */ };

void crop_copy_to(crop_copy *copy, const char *end)
{
    crop_put(copy->c, copy->side, copy->from, (size_t)(end - copy->from));
    copy->from = end;
}

void crop_copy_number(crop_copy *copy, const char *word, size_t length, uint64_t number)
{
    char digits[DIGITS_MOST];
    size_t at = DIGITS_MOST;
    do
        digits[--at] = (char)('0' + number % 10);
    while (number /= 10);
    crop_copy_to(copy, word);
    crop_put(copy->c, copy->side, digits + at, DIGITS_MOST - at);
    copy->from = word + length;
}

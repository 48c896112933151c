/* test_numbers.c - numbers as texts spell them are the nearest doubles: against the C library, at halfway points and at random. */
#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "console/digits.h"
#include "console/written_number.h"

static uint64_t seed = 1;

static uint64_t draw(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

static void fail_number(const char *text, const char *what, double found, double due)
{
    fail_msg("%s: %s %a, due %a (seed %" PRIu64 ")", text, what, found, due, seed);
}

/* What follows a number ends it. is_plain: the fast way has to know it. */
static void check(const char *text, bool is_plain)
{
    char padded[128];
    const size_t length = strlen(text);
    double due = strtod(text, NULL), whole = 0, scanned = 0;
    float_fit fit = FLOAT_FIT_EXACT, own = FLOAT_FIT_EXACT;
    memset(padded, '7', sizeof padded);
    memcpy(padded, text, length);
    padded[length] = ' ';
    padded[sizeof padded - 1] = '\0';
    if (!written_number_read(padded, length, &whole, &fit) || memcmp(&whole, &due, sizeof due))
        fail_number(text, "read as", whole, due);
    const char *const end = written_number_scan(padded, &scanned, &own);
    if (!end && !is_plain)
        return;
    if (end != padded + length || memcmp(&scanned, &due, sizeof due))
        fail_number(text, "scanned as", scanned, due);
    if (own != fit)
        fail_msg("%s: fits float as %d and %d (seed %" PRIu64 ")", text, (int)own, (int)fit, seed);
    own = FLOAT_FIT_NONE;
    assert_ptr_equal(written_number_scan(padded, &scanned, &own), end);
    assert_int_equal(own, FLOAT_FIT_NONE);
}

static void test_spellings(void **state)
{
    char plain[] = "0 -0 +1 1. .5 -.5e1 1e5 1E-5 1e+05 00012.5000 0.00000000000000000001 12345678 123456789 1234567.8 "
                   "12345678.12345678 1234567890123456789 9999999999999999999 0.30000001192092896 1.00000005960464477 "
                   "-123456789.123456789 0.1 557820.15 1e22 1e23 8.5e-23 9007199254740993 9007199254740993e5 1e0001 ";
    char others[] = "3.4028235e38 1.17549435e-38 12345678901234567890 1e400 -1e-400 4.9e-324 2.2250738585072011e-308 1e00001 "
                    "1.7976931348623158e308 1e-300 0.500000000000000166533453693773481063544750213623046875 ";
    (void)state;
    for (const char *text = strtok(plain, " "); text; text = strtok(NULL, " "))
        check(text, true);
    for (const char *text = strtok(others, " "); text; text = strtok(NULL, " "))
        check(text, false);
}

/* What is no number to the one is none to the other, or ends where the number does. */
static void test_no_numbers(void **state)
{
    static const char *const texts[] = {"", "-", "+", ".", "-.", "e5", "1e", "1e+", "nan", "inf", "--1", "+-1"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char padded[64] = {0};
        double number;
        float_fit fit = FLOAT_FIT_EXACT;
        strcpy(padded, texts[i]);
        if (written_number_scan(padded, &number, &fit))
            fail_msg("'%s' is taken for a number", texts[i]);
    }
}

/* No other byte counts as a digit, before or after eight of them. */
static void test_ends(void **state)
{
    (void)state;
    for (int c = 0; c < 256; c++)
        for (size_t length = 1; length < 18; length++) {
            char text[64];
            double number;
            float_fit fit = FLOAT_FIT_EXACT;
            if ((c >= '0' && c <= '9') || c == '.' || c == 'e' || c == 'E')
                continue;
            memset(text, '7', sizeof text);
            text[length] = (char)c;
            assert_ptr_equal(written_number_scan(text, &number, &fit), text + length);
        }
}

/* Whole numbers of 54 to 64 bits, many of them just halfway between two doubles, with the point and the exponent anywhere. */
static void test_halfway(void **state)
{
    (void)state;
    for (int i = 0; i < 200000; i++) {
        char text[80], digits[32];
        const int zeros = (int)(draw() % 12);
        const uint64_t top = draw() >> zeros >> 1, half = UINT64_C(1) << (10 - (zeros < 10 ? zeros : 10));
        const uint64_t number = draw() % 2 ? top : (top | (half - 1)) - (half - 1) + half / 2 + draw() % 3 - 1;
        if (number > UINT64_C(9999999999999999999))
            continue;
        snprintf(digits, sizeof digits, "%" PRIu64, number);
        const int length = (int)strlen(digits), whole = (int)(draw() % (uint64_t)(length + 1));
        const int exponent = (int)(draw() % 40) - 20, places = length - whole - exponent;
        snprintf(text, sizeof text, "%s%.*s.%se%d", draw() % 2 ? "-" : "", whole, digits, digits + whole, exponent);
        check(text, number && places <= 27 && places >= -27);
    }
}

static void test_random(void **state)
{
    (void)state;
    for (int i = 0; i < 200000; i++) {
        char text[80];
        const double fraction = (double)(draw() >> 11) / 9007199254740992.0, size = (double)(1 << draw() % 30) / (1 << draw() % 30);
        snprintf(text, sizeof text, draw() % 2 ? "%.*g" : "%.*f", 1 + (int)(draw() % 17), fraction * size);
        check(text, false);
    }
}

int main(int count, char **words)
{
    if (count > 2 && !strcmp(words[1], "--seed"))
        seed = strtoull(words[2], NULL, 0) | 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spellings), cmocka_unit_test(test_no_numbers),
                                       cmocka_unit_test(test_ends), cmocka_unit_test(test_halfway), cmocka_unit_test(test_random)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

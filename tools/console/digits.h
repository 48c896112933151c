/* digits.h - the digits that a text begins with, eight at once. */
#ifndef DIGITS_H
#define DIGITS_H

#include <stdint.h>
#include <string.h>

/* Bytes that are looked at after the last digit, whatever they are. */
enum { DIGITS_AHEAD = 8 };

/* The first byte lowest. */
static inline uint64_t digits_load(const char *text)
{
    uint64_t bytes;
    memcpy(&bytes, text, sizeof bytes);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    bytes = __builtin_bswap64(bytes);
#endif
    return bytes;
}

/* How many of eight bytes are digits before the first other one. values: each byte less '0'. Carries only reach later bytes. */
static inline unsigned digits_leading(uint64_t values)
{
    const uint64_t others = ((values + UINT64_C(0x7676767676767676)) | values) & UINT64_C(0x8080808080808080);
    return others ? (unsigned)__builtin_ctzll(others) / 8 : 8;
}

/* The number that eight digits spell: neighbours are joined, then pairs, then fours. */
static inline uint64_t digits_join(uint64_t values)
{
    values = (values * 10 + (values >> 8)) & UINT64_C(0x00FF00FF00FF00FF);
    values = (values * 100 + (values >> 16)) & UINT64_C(0x0000FFFF0000FFFF);
    return (values * 10000 + (values >> 32)) & UINT64_C(0xFFFFFFFF);
}

static inline unsigned digits_value(char c) { return (unsigned char)(c - '0'); }

/*
 * Appends digits to a number, up to where it ends, which it returns; of more than 19 the number is of no use. Most numbers have one
 * before the point, and few after the first eight: those are read one by one.
 */
static inline const char *digits_scan(const char *text, uint64_t *number)
{
    static const uint32_t tens[8] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};
    if (digits_value(text[0]) < 10 && digits_value(text[1]) < 10) {
        const uint64_t values = digits_load(text) ^ UINT64_C(0x3030303030303030);
        const unsigned count = digits_leading(values);
        *number = *number * (count < 8 ? tens[count] : 100000000) + digits_join(values << (64 - 8 * count));
        text += count;
        if (count < 8)
            return text;
    }
    for (; digits_value(*text) < 10; text++)
        *number = *number * 10 + digits_value(*text);
    return text;
}

#endif
